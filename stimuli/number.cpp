#include "stimuli/number.h"

#include <charconv>
#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr size_t kLongestList = 1'000'000;

void append_range(std::vector<double>& values, const std::vector<std::string>& parts, const std::string& subject,
                  const std::string& text) {
    const auto start = parse_number(parts[0]);
    const auto step = parse_number(parts[1]);
    const auto stop = parse_number(parts[2]);
    if (!start || !step || !stop || !(*step > 0) || *stop < *start) {
        throw InputError(subject, "\"" + text + "\" is no range", "write start:step:stop, for example 0:5:80");
    }
    // A stop that a step meets up to rounding counts.
    const double steps = std::floor((*stop - *start) / *step + 1e-9);
    if (!(steps < static_cast<double>(kLongestList))) {
        throw InputError(subject, "\"" + text + "\" has more than 10^6 values", "use a larger step");
    }
    for (size_t i = 0; i <= static_cast<size_t>(steps); ++i) values.push_back(*start + i * *step);
}

}  // namespace

std::string format_number(double value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, result.ptr};
}

std::string format_fixed(double value, int decimals) {
    char buffer[400];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
    return {buffer, result.ptr};
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
    if (!whole || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::vector<double> parse_number_list(std::string_view text, const std::string& subject) {
    std::vector<double> values;
    for (const std::string& part : split(text, ',')) {
        const std::vector<std::string> range = split(part, ':');
        if (range.size() == 3) {
            append_range(values, range, subject, part);
        } else if (const auto value = parse_number(part)) {
            values.push_back(*value);
        } else {
            throw InputError(subject, "\"" + part + "\" is no number", "list numbers, for example 5,10,20 or 0:5:80");
        }
        if (values.size() > kLongestList) {
            throw InputError(subject, "has more than 10^6 values", "list fewer");
        }
    }
    return values;
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    if (text.empty()) return parts;
    size_t begin = 0;
    for (size_t end; (end = text.find(separator, begin)) != std::string_view::npos; begin = end + 1) {
        parts.emplace_back(text.substr(begin, end - begin));
    }
    parts.emplace_back(text.substr(begin));
    return parts;
}

}  // namespace stairstep
