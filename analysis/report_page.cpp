#include "analysis/report_page.h"

#include <cassert>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"

namespace stairstep {
namespace {

std::string base64(const std::string& bytes) {
    constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += kAlphabet[group >> 18];
        text += kAlphabet[group >> 12 & 63];
        text += i + 1 < bytes.size() ? kAlphabet[group >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? kAlphabet[group & 63] : '=';
    }
    return text;
}

}  // namespace

Page& Page::set(const std::string& name, const std::string& html) {
    const std::string mark = "{{" + name + "}}";
    assert(html_.find(mark) != std::string::npos);
    for (size_t at = 0; (at = html_.find(mark, at)) != std::string::npos; at += html.size()) {
        html_.replace(at, mark.size(), html);
    }
    return *this;
}

std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
    if (rows.empty()) return "";
    std::string html = "<table>\n<thead><tr>";
    for (const std::string& cell : head) html += "<th>" + escaped(cell) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const auto& row : rows) {
        assert(row.size() == head.size());
        html += "<tr>";
        for (const std::string& cell : row) html += "<td>" + escaped(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table>\n";
}

std::string embedded_png(const std::filesystem::path& path, const std::string& description) {
    const std::string bytes = read_file(path);
    if (!bytes.starts_with("\x89PNG")) throw InputError(path.string(), "is no PNG", "name a PNG");
    return "<img alt=\"" + escaped(description) + "\" src=\"data:image/png;base64," + base64(bytes) + "\">";
}

std::string inline_svg(const std::string& svg) {
    std::string part;
    for (size_t i = svg.find("<svg"); i < svg.size(); ++i) {
        if (svg[i] == '{') {
            part += "&#123;";  // a name in the figure could look like a place of the template
        } else {
            part += svg[i];
        }
    }
    return part;
}

}  // namespace stairstep
