// Numbers as text, the same in every file and locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stairstep {

/// The shortest decimal text that reads back as the same double: 0.1 → "0.1", 640 → "640".
std::string format_number(double value);

/// value with a fixed number of decimals, for people: format_fixed(3.4683, 2) → "3.47".
std::string format_fixed(double value, int decimals);

/// The whole of text as a finite number; nullopt for anything else ("", "1x", "nan", "inf", "1e999").
std::optional<double> parse_number(std::string_view text);

/// "5,10,20" or "0:2:80" (start:step:stop, the stop included where a step meets it), or a mix. `subject` names
/// the flag in errors. Throws InputError for anything else and for more than 10⁶ values.
std::vector<double> parse_number_list(std::string_view text, const std::string& subject);

/// "a,b,c" → its parts; an empty text has none.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace stairstep
