#include "stimuli/io/json_object.h"

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {

using nlohmann::json;

namespace {

std::optional<double> number_in(const json& value) {
    if (!value.is_number()) return std::nullopt;
    const double number = value.get<double>();
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

JsonObject::JsonObject(const json& value, std::string source) : value_(value), source_(std::move(source)) {
    if (!value_.is_object()) throw InputError(source_, "is no JSON object", "write { … }");
}

const json* JsonObject::find(const std::string& key) {
    asked_for_.insert(key);
    const auto entry = value_.find(key);
    return entry == value_.end() ? nullptr : &*entry;
}

void JsonObject::reject(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(source_ + ", \"" + key + "\"", problem, remedy);
}

void JsonObject::read(const std::string& key, double& field) {
    const json* value = find(key);
    if (!value) return;
    const auto number = number_in(*value);
    if (!number) reject(key, "is no finite number", "write for example 0.5");
    field = *number;
}

void JsonObject::read(const std::string& key, std::optional<double>& field) {
    const json* value = find(key);
    if (!value) return;
    field.reset();
    if (value->is_null()) return;
    field.emplace();
    read(key, *field);
}

void JsonObject::read(const std::string& key, int& field) {
    const json* value = find(key);
    if (!value) return;
    const auto number = number_in(*value);
    if (!number || *number != std::floor(*number) || std::abs(*number) > 2e9) {
        reject(key, "is no whole number", "write for example 40");
    }
    field = static_cast<int>(*number);
}

void JsonObject::read(const std::string& key, uint64_t& field) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_number_unsigned()) reject(key, "is no whole number from 0 on", "write for example 1");
    field = value->get<uint64_t>();
}

void JsonObject::read(const std::string& key, bool& field) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_boolean()) reject(key, "is neither true nor false", "write true or false");
    field = value->get<bool>();
}

void JsonObject::read(const std::string& key, std::string& field) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_string()) reject(key, "is no text", "put it between quotes");
    field = value->get<std::string>();
}

void JsonObject::read(const std::string& key, std::vector<double>& field) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_array()) reject(key, "is no list", "write for example [5, 10]");
    field.clear();
    for (const json& entry : *value) {
        const auto number = number_in(entry);
        if (!number) reject(key, "holds something else than finite numbers", "write for example [5, 10]");
        field.push_back(*number);
    }
}

void JsonObject::read(const std::string& key, std::vector<std::string>& field) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_array()) reject(key, "is no list", "write for example [\"step\"]");
    field.clear();
    for (const json& entry : *value) {
        if (!entry.is_string()) reject(key, "holds something else than text", "write for example [\"step\"]");
        field.push_back(entry.get<std::string>());
    }
}

JsonObject JsonObject::object(const std::string& key) {
    const json* value = find(key);
    return JsonObject(value ? *value : json::object(), source_ + ", \"" + key + "\"");
}

void JsonObject::refuse_other_keys() const {
    for (const auto& [key, value] : value_.items()) {
        if (!asked_for_.contains(key)) {
            std::string known;
            for (const std::string& name : asked_for_) known += (known.empty() ? "" : ", ") + name;
            reject(key, "is no key known here", "use one of: " + known);
        }
    }
}

}  // namespace stairstep
