#include "stimuli/io/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "stimuli/error.h"
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

}  // namespace

Image contact_sheet(const std::vector<Stimulus>& stimuli) {
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

    const int row_height = kCellHeight + kLabelHeight + kGap;
    const int block_height = kHeadingHeight + static_cast<int>(texels.size()) * row_height;
    const int columns_width = kMarginLeft + static_cast<int>(radii.size()) * (kCellWidth + kGap) + kGap;
    Image sheet(std::max(columns_width, kHeadingWidth), static_cast<int>(patterns.size()) * block_height + kGap, 1);
    std::fill(sheet.pixels.begin(), sheet.pixels.end(), kPaper);

    int top = 0;
    for (const Pattern pattern : patterns) {
        draw_text(sheet, kGap, top + 24,
                  std::string(name(pattern)) + ", contrast " + format_number(100 * first->contrast) + " %, " +
                      std::string(name(first->kernel.shape)) +
                      " filter: texel size a down, filter radius r across (px)",
                  18, kInk);
        for (size_t c = 0; c < radii.size(); ++c) {
            const int left = kMarginLeft + static_cast<int>(c) * (kCellWidth + kGap);
            draw_text(sheet, left, top + 50, "r = " + format_number(radii[c]), 16, kInk);
        }
        top += kHeadingHeight;
        for (const double texel_px : texels) {
            draw_text(sheet, kGap, top + kCellHeight / 2, "a = " + format_number(texel_px), 16, kInk);
            for (size_t c = 0; c < radii.size(); ++c) {
                const int left = kMarginLeft + static_cast<int>(c) * (kCellWidth + kGap);
                const auto stimulus = std::find_if(shown.begin(), shown.end(), [&](const Stimulus& s) {
                    return s.pattern == pattern && s.texel_px == texel_px && s.kernel.radius_px == radii[c];
                });
                if (stimulus == shown.end()) continue;  // a grid from a file may have gaps
                draw_cell(sheet, *stimulus, left, top);
                draw_text(sheet, left, top + kCellHeight + 15, format_fixed(radii[c] / texel_px, 1) + " texels", 13,
                          kInk);
            }
            top += row_height;
        }
    }
    return sheet;
}

}  // namespace stairstep
