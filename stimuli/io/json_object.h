// A JSON object that a person wrote: every key has a default, and one that nobody asks for is refused, since it is most likely
// misspelt.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace stairstep {

class JsonObject {
  public:
    /// `source` names the object in errors: "design.json", "design.json: engine". Throws InputError for a value that is no
    /// object.
    JsonObject(const nlohmann::json& value, std::string source);

    /// Each takes the value at a key into `field`, or leaves it where the key is missing. All throw InputError, naming source
    /// and key, for a value of another kind; numbers are finite.
    void read(const std::string& key, double& field);
    void read(const std::string& key, std::optional<double>& field);
    void read(const std::string& key, int& field);
    /// From 0 to 2⁶⁴ − 1, all digits kept: a seed.
    void read(const std::string& key, uint64_t& field);
    void read(const std::string& key, bool& field);
    void read(const std::string& key, std::string& field);
    void read(const std::string& key, std::vector<double>& field);
    void read(const std::string& key, std::vector<std::string>& field);

    /// Text that `parse` must understand: returns an optional. `allowed` tells in the error what would do.
    template <typename T, typename Parse>
    void read_named(const std::string& key, T& field, const Parse& parse, const char* allowed) {
        std::string text;
        if (!contains(key)) return;
        read(key, text);
        const auto value = parse(text);
        if (!value) reject(key, "\"" + text + "\" is unknown", std::string("use ") + allowed);
        field = *value;
    }

    bool contains(const std::string& key) const { return value_.contains(key); }

    /// The object at a key; an empty one where the key is missing.
    JsonObject object(const std::string& key);

    /// Throws InputError for the first key that was never asked for.
    void refuse_other_keys() const;

    [[noreturn]] void reject(const std::string& key, const std::string& problem, const std::string& remedy) const;

  private:
    const nlohmann::json* find(const std::string& key);

    nlohmann::json value_;
    std::string source_;
    std::set<std::string> asked_for_;
};

}  // namespace stairstep
