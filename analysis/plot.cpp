#include "analysis/plot.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stimuli/io/gnuplot.h"
#include "stimuli/number.h"

namespace stairstep {

const char* colour(Pattern pattern) {
    return pattern == Pattern::step ? "#0072b2" : "#d55e00";
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') result += '\'';
        result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
    return result + "'";
}

std::string shortened(const std::string& text, size_t bytes) {
    if (text.size() <= bytes) return text;
    while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80) --bytes;
    return text.substr(0, bytes);
}

double tic_step(double range, int most) {
    const double least = range / most;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least * (1 - 1e-9)) return step * power;
    }
    return 10 * power;
}

int panel_columns(size_t panels) {
    int best = 2;
    const auto empty = [&](int columns) {
        const size_t n = static_cast<size_t>(columns);
        return (n - panels % n) % n;
    };
    for (const int columns : {3, 4}) {
        if (empty(columns) <= empty(best) && (panels > 2)) best = columns;
    }
    return best;
}

std::ostringstream& Plot::block(const std::string& name) {
    blocks_.emplace_back(name, std::ostringstream());
    return blocks_.back().second;
}

void Plot::draw(const std::string& block, const std::string& how) {
    parts_.emplace_back(block, "$" + block + " " + how);
}

void Plot::draw_function(const std::string& what) {
    parts_.emplace_back("", what);
}

std::string Plot::script() const {
    std::string text;
    for (const auto& [name, rows] : blocks_) {
        if (!rows.view().empty()) text += "$" + name + " << EOD\n" + rows.str() + "EOD\n";
    }
    std::string parts;
    for (const auto& [block, part] : parts_) {
        const bool is_drawn = block.empty() || std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& b) {
                                  return b.first == block && !b.second.view().empty();
                              });
        if (is_drawn) parts += (parts.empty() ? "" : ", \\\n  ") + part;
    }
    return text + "plot " + (parts.empty() ? "NaN notitle" : parts) + "\n";
}

void Panels::add(const std::string& settings, const Plot& plot) {
    panels_.push_back(settings + plot.script());
}

void Panels::end_row() {
    while (panels_.size() % static_cast<size_t>(layout_.columns) != 0) panels_.emplace_back();
}

std::string Panels::svg() const {
    assert(!panels_.empty());
    const int rows = (static_cast<int>(panels_.size()) + layout_.columns - 1) / layout_.columns;
    const int height = rows * layout_.panel_height;
    const double column_width = static_cast<double>(layout_.width) / layout_.columns;
    std::string script = "set termoption noenhanced\nset termoption font 'Helvetica," + std::to_string(layout_.font) +
                         "'\nset multiplot\nset tics scale 0.6,0.3\n";
    for (size_t i = 0; i < panels_.size(); ++i) {
        if (panels_[i].empty()) continue;
        const int row = static_cast<int>(i) / layout_.columns;
        const int column = static_cast<int>(i) % layout_.columns;
        const auto x = [&](double px) { return format_fixed((column * column_width + px) / layout_.width, 6); };
        const auto y = [&](double px) { return format_fixed(1 - (row * layout_.panel_height + px) / height, 6); };
        script +=
            "unset key\nunset label\nunset arrow\nunset logscale\nset xtics autofreq offset 0,0.35\nset ytics autofreq "
            "offset 0.5,0\n"
            "set title '' offset 0,-0.6\nset xlabel '' offset 0,0.75\nset ylabel '' offset 1.2,0\nset grid noxtics "
            "ytics\n"
            "set lmargin at screen " +
            x(layout_.left) + "\nset rmargin at screen " + x(column_width - layout_.right) +
            "\nset tmargin at screen " + y(layout_.top) + "\nset bmargin at screen " +
            y(layout_.panel_height - layout_.bottom) + "\n" + panels_[i];
    }
    return draw_svg(script + "unset multiplot\nset tics scale 0.6,0.3\n", layout_.width, height);
}

}  // namespace stairstep
