#include "stimuli/io/utf8.h"

#include <cstdint>

namespace stairstep {
namespace {

/// A character of `length` bytes starts with a byte in [first, last]; its code point is at least `least`, or it is overlong.
struct Form {
    uint8_t first;
    uint8_t last;
    size_t length;
    uint32_t least;
};

constexpr Form kForms[] = {{0x00, 0x7f, 1, 0}, {0xc0, 0xdf, 2, 0x80}, {0xe0, 0xef, 3, 0x800}, {0xf0, 0xf7, 4, 0x10000}};

const Form* form_of(uint8_t first) {
    for (const Form& form : kForms) {
        if (first >= form.first && first <= form.last) return &form;
    }
    return nullptr;
}

}  // namespace

bool is_utf8(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto first = static_cast<uint8_t>(bytes[0]);
        const Form* form = form_of(first);
        if (!form || form->length > bytes.size()) return false;
        uint32_t code = first - form->first;
        for (size_t i = 1; i < form->length; ++i) {
            const auto next = static_cast<uint8_t>(bytes[i]);
            if ((next & 0xc0) != 0x80) return false;
            code = code << 6 | (next & 0x3f);
        }
        const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
        if (code < form->least || is_surrogate || code > 0x10ffff) return false;
        bytes.remove_prefix(form->length);
    }
    return true;
}

}  // namespace stairstep
