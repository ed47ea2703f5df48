// Figures of several panels for gnuplot: data blocks, the parts that draw them, and panels placed to the pixel.
#pragma once

#include <deque>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "stimuli/edge.h"

namespace stairstep {

/// Two colours that differ for every kind of colour vision (Okabe & Ito 2008).
const char* colour(Pattern pattern);

/// A text as gnuplot's quoted string: quotes doubled, control characters as spaces. Figures are set without markup, so that an
/// underscore is one.
std::string quoted(const std::string& text);

/// The first `bytes` of a text at most, no character cut in two.
std::string shortened(const std::string& text, size_t bytes);

/// The smallest of 1, 2, 5, 10, 20, … (and .5, .2, .1, …) that divides `range` > 0 into at most `most` parts.
double tic_step(double range, int most);

/// 2 to 4 columns for so many panels: those that leave the fewest places empty, rather more than fewer.
int panel_columns(size_t panels);

/// What one panel draws: data blocks ($name << EOD) and the parts of the plot command that draw them.
class Plot {
  public:
    /// Opens a data block and returns it for rows; it stays valid while others are opened.
    std::ostringstream& block(const std::string& name);
    /// "u 1:2 w l" of a block; left out where the block has no row, which gnuplot would refuse.
    void draw(const std::string& block, const std::string& how);
    /// A function of x, or what else needs no block.
    void draw_function(const std::string& what);

    std::string script() const;

  private:
    std::deque<std::pair<std::string, std::ostringstream>> blocks_;  // references into it stay valid
    std::vector<std::pair<std::string, std::string>> parts_;
};

/// A grid of panels of one size on a page's width.
class Panels {
  public:
    /// All px. Around each panel's axes: room for title and labels.
    struct Layout {
        int columns = 1;
        int width = 1020;
        int panel_height = 240;
        int left = 62, right = 14, top = 28, bottom = 44;
        int font = 13;
    };
    explicit Panels(const Layout& layout) : layout_(layout) {}

    /// The next panel, row by row. `settings` are gnuplot's, title, labels and both ranges among them; nothing is left over from
    /// the panel before.
    void add(const std::string& settings, const Plot& plot);

    /// Leaves the rest of a row that has begun empty.
    void end_row();

    /// Throws FailureError where gnuplot can't draw. A panel at least (asserted).
    std::string svg() const;

  private:
    Layout layout_;
    std::vector<std::string> panels_;
};

}  // namespace stairstep
