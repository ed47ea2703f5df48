#include "stimuli/io/json_file.h"

#include <cassert>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"

namespace stairstep {
namespace {

constexpr int kDeepest = 100;

[[noreturn]] void reject_key(const std::string& source, const std::string& key, const std::string& problem) {
    throw InputError(source, "\"" + key + "\" " + problem, "compare it with law.json in the README");
}

[[maybe_unused]] bool holds_only_finite_numbers(const nlohmann::ordered_json& value) {
    if (value.is_number_float()) return std::isfinite(value.get<double>());
    for (const auto& element : value) {
        if (element.is_structured() ? !holds_only_finite_numbers(element)
                                    : element.is_number_float() && !std::isfinite(element.get<double>())) {
            return false;
        }
    }
    return true;
}

}  // namespace

nlohmann::json read_json(const std::filesystem::path& path) {
    return parse_json(read_file(path), path.string());
}

nlohmann::json parse_json(std::string_view text, const std::string& source) {
    const auto within_depth = [&source](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
        // Values are copied and written by recursion, which would run out of stack.
        if (depth > kDeepest) throw InputError(source, "nests over 100 deep", "write it again");
        return true;
    };
    auto value = nlohmann::json::parse(text, within_depth, false);
    if (value.is_discarded()) throw InputError(source, "is not JSON, or cut short", "write it again");
    if (!value.is_object()) throw InputError(source, "holds no JSON object", "write it again");
    return value;
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& value) {
    assert(holds_only_finite_numbers(value));
    write_file(path, value.dump(2) + "\n");
}

double json_number(const nlohmann::json& object, const std::string& key, const std::string& source) {
    const auto found = object.find(key);
    if (found == object.end()) reject_key(source, key, "is missing");
    if (!found->is_number() || !std::isfinite(found->get<double>())) reject_key(source, key, "is no finite number");
    return found->get<double>();
}

std::string json_text(const nlohmann::json& object, const std::string& key, const std::string& source) {
    const auto found = object.find(key);
    if (found == object.end()) reject_key(source, key, "is missing");
    if (!found->is_string()) reject_key(source, key, "is no text");
    return found->get<std::string>();
}

std::pair<double, double> json_range(const nlohmann::json& object, const std::string& key, const std::string& source) {
    const auto found = object.find(key);
    if (found == object.end()) reject_key(source, key, "is missing");
    const bool is_pair = found->is_array() && found->size() == 2 && (*found)[0].is_number() && (*found)[1].is_number();
    if (!is_pair) reject_key(source, key, "is no pair of numbers");
    const std::pair range((*found)[0].get<double>(), (*found)[1].get<double>());
    if (!std::isfinite(range.first) || !std::isfinite(range.second) || range.first > range.second) {
        reject_key(source, key, "is no ascending pair");
    }
    return range;
}

}  // namespace stairstep
