// The pieces that the report's page is made of: a template with places, tables, pictures inside the page.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stimuli/io/html.h"

namespace stairstep {

/// Replaces each {{name}} of a template; a value without a place in it is a bug (asserted).
class Page {
  public:
    explicit Page(std::string_view html) : html_(html) {}

    Page& set(const std::string& name, const std::string& html);
    Page& text(const std::string& name, const std::string& text) { return set(name, escaped(text)); }

    const std::string& html() const { return html_; }

  private:
    std::string html_;
};

/// A table of texts, which are escaped here; rows of as many cells as the head. "" without rows.
std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);

/// An <img> with the PNG in it. Throws InputError for a file that is missing or no PNG.
std::string embedded_png(const std::filesystem::path& path, const std::string& description);

/// An SVG as part of a page: without the XML header, which has no place there, and { escaped.
std::string inline_svg(const std::string& svg);

}  // namespace stairstep
