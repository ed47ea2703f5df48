// The transfer: which value a file stores for a luminance. A display undoes it, so that the observer sees the luminance
// that was meant; luminance is relative to the brightest that the display shows, stored values to the largest level.
//
//   linear     v = L
//   srgb       v = 12.92·L for L ≤ 0.0031308, else 1.055·L^(1/2.4) − 0.055            (IEC 61966-2-1)
//   gamma=g    v = L^(1/g)
//   a table    measured pairs (v, L), strictly increasing in both, interpolated linearly
//
// Anchors (tests/stimuli/transfer_test.cpp): srgb stores L = 0.2140411 as 0.5 and 0.18 as 0.4613561; gamma=2 stores
// 0.25 as 0.5.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stairstep {

class Transfer {
  public:
    /// A measurement: a stored value in [0, 1] and the luminance it shows, relative to the brightest.
    struct Point {
        double level = 0;
        double luminance = 0;
    };

    /// linear
    Transfer() = default;
    /// "linear", "srgb" or "gamma=2.2"; nullopt for any other text. Throws InputError for a gamma outside [0.1, 10].
    static std::optional<Transfer> named(std::string_view text);
    /// A measured display. Two points or more, both members strictly increasing, levels from 0 to 1, the last luminance
    /// 1.
    static Transfer table(std::vector<Point> points);

    /// The stored value in [0, 1] of a luminance in [0, 1]. A luminance below a table's first is stored as 0: the
    /// display shows nothing darker.
    double encode(double luminance) const;
    /// The luminance that a stored value shows: the inverse of `encode`.
    double decode(double level) const;

    /// Text that tells transfers apart: as `named` takes it, or for a table "transfer-", a hash of its points and
    /// ".csv".
    const std::string& name() const { return name_; }
    /// The points of a table; empty for the others.
    const std::vector<Point>& points() const { return points_; }

  private:
    enum class Curve { linear, srgb, gamma, table };

    Curve curve_ = Curve::linear;
    double gamma_ = 1;
    std::vector<Point> points_;
    std::string name_ = "linear";
};

}  // namespace stairstep
