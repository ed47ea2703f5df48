#include "stimuli/io/html.h"

namespace stairstep {

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        switch (c) {
            case '&': html += "&amp;"; break;
            case '<': html += "&lt;"; break;
            case '>': html += "&gt;"; break;
            case '"': html += "&quot;"; break;
            case '{': html += "&#123;"; break;  // or it could look like a place of the template
            default: html += c;
        }
    }
    return html;
}

}  // namespace stairstep
