// JSON files, with errors that name the file and the key.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace stairstep {

/// Parses a JSON file whose top level is an object. Throws InputError for a missing or malformed one, and for one that
/// nests over 100 deep.
nlohmann::json read_json(const std::filesystem::path& path);

/// As `read_json`, from text; `source` stands for the file's name in errors.
nlohmann::json parse_json(std::string_view text, const std::string& source);

/// Writes a whole file, indented by two, keys in the order given. A value that JSON cannot hold (NaN, infinity)
/// is a bug and asserts. Throws FailureError.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value);

/// The finite number at a key. Throws InputError naming source and key where it is missing or something else.
double json_number(const nlohmann::json& object, const std::string& key, const std::string& source);

/// The text at a key. Throws as `json_number`.
std::string json_text(const nlohmann::json& object, const std::string& key, const std::string& source);

/// A two-element array of finite numbers, ascending. Throws as `json_number`.
std::pair<double, double> json_range(const nlohmann::json& object, const std::string& key, const std::string& source);

}  // namespace stairstep
