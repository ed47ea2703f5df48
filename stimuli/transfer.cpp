#include "stimuli/transfer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

using Point = Transfer::Point;
using Member = double Point::*;

/// The polyline through the points, read from one member to the other; constant past its ends.
double interpolate(const std::vector<Point>& points, Member from, Member to, double value) {
    const auto above = std::upper_bound(points.begin(), points.end(), value,
                                        [from](double v, const Point& point) { return v < point.*from; });
    if (above == points.begin()) return points.front().*to;
    if (above == points.end()) return points.back().*to;
    const Point& low = *(above - 1);
    const double share = (value - low.*from) / ((*above).*from - low.*from);
    return low.*to + share * ((*above).*to - low.*to);
}

/// FNV-1a, 64 bits, as 16 hexadecimal digits.
std::string hash_of(std::string_view text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 15];
    return digits;
}

}  // namespace

std::optional<Transfer> Transfer::named(std::string_view text) {
    Transfer transfer;
    transfer.name_ = text;
    if (text == "linear") return transfer;
    if (text == "srgb") {
        transfer.curve_ = Curve::srgb;
        return transfer;
    }
    constexpr std::string_view kGamma = "gamma=";
    if (!text.starts_with(kGamma)) return std::nullopt;
    const auto gamma = parse_number(text.substr(kGamma.size()));
    if (!gamma || *gamma < 0.1 || *gamma > 10) {
        throw InputError("transfer " + std::string(text), "gamma must be a number from 0.1 to 10",
                         "use for example gamma=2.2");
    }
    transfer.curve_ = Curve::gamma;
    transfer.gamma_ = *gamma;
    transfer.name_ = std::string(kGamma) + format_number(*gamma);
    return transfer;
}

Transfer Transfer::table(std::vector<Point> points) {
    assert(points.size() >= 2 && points.front().level == 0 && points.back().level == 1);
    assert(points.back().luminance == 1);
    std::string text;
    for (const Point& point : points) {
        text += format_number(point.level) + ',' + format_number(point.luminance) + '\n';
    }
    Transfer transfer;
    transfer.curve_ = Curve::table;
    transfer.points_ = std::move(points);
    transfer.name_ = "transfer-" + hash_of(text) + ".csv";
    return transfer;
}

double Transfer::encode(double luminance) const {
    switch (curve_) {
        case Curve::linear: return luminance;
        case Curve::srgb:
            return luminance <= 0.0031308 ? 12.92 * luminance : 1.055 * std::pow(luminance, 1 / 2.4) - 0.055;
        case Curve::gamma: return std::pow(luminance, 1 / gamma_);
        case Curve::table: break;
    }
    return interpolate(points_, &Point::luminance, &Point::level, luminance);
}

double Transfer::decode(double level) const {
    switch (curve_) {
        case Curve::linear: return level;
        case Curve::srgb: return level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
        case Curve::gamma: return std::pow(level, gamma_);
        case Curve::table: break;
    }
    return interpolate(points_, &Point::level, &Point::luminance, level);
}

}  // namespace stairstep
