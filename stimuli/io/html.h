// Text in HTML pages.
#pragma once

#include <string>

namespace stairstep {

/// A text as HTML: & < > " and { escaped, the last as pages are made from templates with places like {{name}}.
std::string escaped(const std::string& text);

}  // namespace stairstep
