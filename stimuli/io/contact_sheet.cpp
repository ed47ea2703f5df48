#include "stimuli/io/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "stimuli/contour.h"
#include "stimuli/draw.h"
#include "stimuli/error.h"
#include "stimuli/io/stroke.h"
#include "stimuli/number.h"
#include "stimuli/visibility.h"

namespace stairstep {
namespace {

constexpr int kCellWidth = 168;
constexpr int kCellHeight = 112;
constexpr int kLabelHeight = 20;
constexpr int kGap = 8;
constexpr int kMarginLeft = 74;
constexpr int kHeadingHeight = 58;
constexpr int kHeadingWidth = 760;
constexpr int kMostColumns = 10;
constexpr uint8_t kPaper = 236;
constexpr uint8_t kInk = 30;

/// Under contours: everything is this much larger, black is this pale, and pens have these widths and colours.
constexpr int kContourScale = 2;
constexpr int kLegendHeight = 28;
constexpr double kPaleShadow = 0.62;
constexpr double kLinePen_px = 3.6;
constexpr double kArtifactPen_px = 1.4;
constexpr std::array<uint8_t, 3> kLineColour{240, 160, 60};
constexpr std::array<uint8_t, 3> kArtifactColour{20, 20, 30};

/// At most `count` of the values, evenly spread, first and last among them.
std::vector<double> spread(const std::set<double>& values, size_t count) {
    const std::vector<double> all(values.begin(), values.end());
    if (all.size() <= count) return all;
    std::vector<double> chosen;
    for (size_t i = 0; i < count; ++i) chosen.push_back(all[i * (all.size() - 1) / (count - 1)]);
    return chosen;
}

/// The middle of the stimulus at half size: each cell pixel averages a 2 × 2 block.
void draw_cell(Image& sheet, const Stimulus& stimulus, int left, int top) {
    const Edge edge = edge_of(stimulus);
    const Filter filter(stimulus.kernel);
    for (int row = 0; row < kCellHeight; ++row) {
        for (int column = 0; column < kCellWidth; ++column) {
            double sum = 0;
            for (const double dy : {-0.5, 0.5}) {
                for (const double dx : {-0.5, 0.5}) {
                    const Point p{2 * (column + 0.5 - kCellWidth / 2.0) + dx, 2 * (kCellHeight / 2.0 - row - 0.5) + dy};
                    sum += filter.visibility(edge, p);
                }
            }
            *sheet.at(left + column, top + row) = static_cast<uint8_t>(level_8bit(stimulus.contrast * sum / 4));
        }
    }
}

/// The contours of one edge in a cell, with one pen.
Coverage trace_contours(const Stimulus& stimulus, int count, int width, int height, double pen_px) {
    const Edge edge = edge_of(stimulus);
    const Filter filter(stimulus.kernel);
    const Window window{-width / 2.0 - pen_px, width / 2.0 + pen_px, -height / 2.0 - pen_px, height / 2.0 + pen_px};
    Coverage coverage(width, height);
    for (const double level : contour_levels(count)) {
        std::vector<Point> places = contour(edge, filter, level, window, 1);
        for (Point& p : places) {
            // What is far above or below stays so; a jump may end anywhere.
            p = {p.x + width / 2.0, height / 2.0 - std::clamp(p.y, -1.0 * height, 1.0 * height)};
        }
        coverage.stroke(places, pen_px);
    }
    return coverage;
}

/// The middle of the stimulus pixel for pixel, pale, under the contours of its line and its own.
void draw_contour_cell(Image& sheet, const Stimulus& stimulus, int count, int left, int top) {
    const int width = kContourScale * kCellWidth;
    const int height = kContourScale * kCellHeight;
    Stimulus middle = stimulus;
    middle.width_px = width;
    middle.height_px = height;
    const auto shading =
        draw<uint8_t>(middle, [](double luminance) { return level_8bit(kPaleShadow + (1 - kPaleShadow) * luminance); });
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            std::fill_n(sheet.at(left + column, top + row), 3, shading[static_cast<size_t>(row) * width + column]);
        }
    }
    Stimulus line = stimulus;  // of the stimulus, not of its middle: a step's line runs along its whole width
    line.pattern = Pattern::line;
    trace_contours(line, count, width, height, kLinePen_px).lay(sheet, left, top, kLineColour);
    trace_contours(stimulus, count, width, height, kArtifactPen_px).lay(sheet, left, top, kArtifactColour);
}

/// "1/6, 2/6 to 5/6", or all where they are few.
std::string levels_named(int count) {
    const auto level = [&](int k) { return std::to_string(k) + "/" + std::to_string(count + 1); };
    std::string text = level(1);
    if (count > 1) text += ", " + level(2);
    if (count > 2) text += (count > 3 ? " to " : ", ") + level(count);
    return text;
}

/// Both pens and what they draw, along the sheet's top.
void draw_legend(Image& sheet, int count) {
    constexpr int kHeight = kContourScale * kLegendHeight;
    constexpr int kBaseline = kContourScale * 22;
    constexpr int kSize = kContourScale * 15;
    constexpr int kSample = kContourScale * 26;
    const auto entry = [&](int left, std::array<uint8_t, 3> colour, double pen_px, const std::string& text) {
        const double middle = kBaseline - 0.36 * kSize;  // of small letters
        Coverage coverage(kSample, kHeight);
        coverage.stroke({{0, middle}, {kSample, middle}}, pen_px);
        coverage.lay(sheet, kContourScale * left, 0, colour);
        draw_text(sheet, kContourScale * (left + kGap) + kSample, kBaseline, text, kSize, kInk);
    };
    draw_text(sheet, kContourScale * kGap, kBaseline, "contours of visibility " + levels_named(count) + ":", kSize,
              kInk);
    entry(300, kArtifactColour, kArtifactPen_px, "artifact");
    entry(410, kLineColour, kLinePen_px, "the line it stands for");
}

}  // namespace

Image contact_sheet(const std::vector<Stimulus>& stimuli, int contours) {
    const int scale = contours == 0 ? 1 : kContourScale;
    if (contours != 0) contour_levels(contours);  // throws for a bad number
    const auto first =
        std::find_if(stimuli.begin(), stimuli.end(), [](const Stimulus& s) { return s.pattern != Pattern::line; });
    if (first == stimuli.end()) {
        throw InputError("contact sheet", "has no artifact to show", "add step or stair to --pattern");
    }
    std::vector<Stimulus> shown;
    std::copy_if(stimuli.begin(), stimuli.end(), std::back_inserter(shown), [&](const Stimulus& s) {
        return s.pattern != Pattern::line && s.contrast == first->contrast && s.kernel.shape == first->kernel.shape;
    });

    std::vector<Pattern> patterns;
    std::set<double> texels;
    std::set<double> radii_listed;
    for (const Stimulus& s : shown) {
        if (std::find(patterns.begin(), patterns.end(), s.pattern) == patterns.end()) patterns.push_back(s.pattern);
        texels.insert(s.texel_px);
        radii_listed.insert(s.kernel.radius_px);
    }
    const std::vector<double> radii = spread(radii_listed, kMostColumns);

    // Lengths below are those of a sheet without contours.
    const int row_height = kCellHeight + kLabelHeight + kGap;
    const int block_height = kHeadingHeight + static_cast<int>(texels.size()) * row_height;
    const int columns_width = kMarginLeft + static_cast<int>(radii.size()) * (kCellWidth + kGap) + kGap;
    const int legend_height = contours == 0 ? 0 : kLegendHeight;
    Image sheet(scale * std::max(columns_width, kHeadingWidth),
                scale * (legend_height + static_cast<int>(patterns.size()) * block_height + kGap),
                contours == 0 ? 1 : 3);
    std::fill(sheet.pixels.begin(), sheet.pixels.end(), kPaper);
    const auto write = [&](int left, int baseline, const std::string& text, int size) {
        draw_text(sheet, scale * left, scale * baseline, text, scale * size, kInk);
    };

    if (contours != 0) draw_legend(sheet, contours);
    int top = legend_height;
    for (const Pattern pattern : patterns) {
        write(kGap, top + 24,
              std::string(name(pattern)) + ", contrast " + format_number(100 * first->contrast) + " %, " +
                  std::string(name(first->kernel.shape)) + " filter: texel size a down, filter radius r across (px)",
              18);
        for (size_t c = 0; c < radii.size(); ++c) {
            const int left = kMarginLeft + static_cast<int>(c) * (kCellWidth + kGap);
            write(left, top + 50, "r = " + format_number(radii[c]), 16);
        }
        top += kHeadingHeight;
        for (const double texel_px : texels) {
            write(kGap, top + kCellHeight / 2, "a = " + format_number(texel_px), 16);
            for (size_t c = 0; c < radii.size(); ++c) {
                const int left = kMarginLeft + static_cast<int>(c) * (kCellWidth + kGap);
                const auto stimulus = std::find_if(shown.begin(), shown.end(), [&](const Stimulus& s) {
                    return s.pattern == pattern && s.texel_px == texel_px && s.kernel.radius_px == radii[c];
                });
                if (stimulus == shown.end()) continue;  // a grid from a file may have gaps
                if (contours == 0) {
                    draw_cell(sheet, *stimulus, left, top);
                } else {
                    draw_contour_cell(sheet, *stimulus, contours, scale * left, scale * top);
                }
                write(left, top + kCellHeight + 15, format_fixed(radii[c] / texel_px, 1) + " texels", 13);
            }
            top += row_height;
        }
    }
    return sheet;
}

}  // namespace stairstep
