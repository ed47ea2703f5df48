// UTF-8, the encoding of all text that goes in and out.
#pragma once

#include <string_view>

namespace stairstep {

/// Whether the bytes are well-formed UTF-8 (The Unicode Standard 15, table 3-7): no overlong form, no surrogate, nothing beyond
/// U+10FFFF.
bool is_utf8(std::string_view bytes);

}  // namespace stairstep
