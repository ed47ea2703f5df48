// The filter kernel: what blurs a shadow edge, in the stimuli and in the renderer alike. This is its only
// home; shaders get its taps and weights as data.
//
// Every kernel has unit mass and a radius r, the half-width of its support:
//   box       a square of side 2r, axis-aligned with the texel grid
//   disk      a disk of radius r
//   gaussian  σ = r/2 (a disk's variance), each axis cut at 1.5 r = 3σ and renormalised
//   poisson   N taps inside the disk
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace stairstep {

enum class KernelShape { box, disk, gaussian, poisson };

std::string_view name(KernelShape shape);
std::optional<KernelShape> kernel_shape_named(std::string_view name);

struct Kernel {
    KernelShape shape = KernelShape::box;
    /// px, ≥ 0; 0 is no filter at all.
    double radius_px = 0;
    /// For poisson: how many taps, which set of them, and whether each pixel turns the set by an angle of its own.
    int taps = 25;
    uint64_t seed = 1;
    bool rotated = false;

    bool operator==(const Kernel&) const = default;
};

/// Most taps of a poisson kernel.
inline constexpr int kMostTaps = 4096;

/// Half the side of the square that holds the support, in units of the radius: 1.5 for gaussian, 1 for the others.
double support(KernelShape shape);

/// Standard deviation along one axis in units of the radius: box 1/√3, disk and poisson 1/2, the cut Gaussian
/// 0.4933 (its σ of 1/2 less what the cut takes). Laws of two kernels compare at equal variance:
/// r₂ = r₁·axis_deviation(shape₁)/axis_deviation(shape₂).
double axis_deviation(KernelShape shape);

/// A sample of the kernel: an offset in units of the radius, and its share of the mass.
struct KernelTap {
    float x = 0;
    float y = 0;
    float weight = 0;
};

/// The box as side × side equal cells, a tap in the middle of each; weights sum to 1. A renderer that shifts
/// all taps by a random part of a cell, anew for each pixel, samples the box without bias. side ≥ 1.
std::vector<KernelTap> box_taps(int side);

/// `count` taps of equal weight inside the disk, no two closer than they must be: darts thrown at a distance that relaxes
/// until all fit (McCool & Fiume 1992). Same count and seed, same taps. count in [1, kMostTaps].
std::vector<KernelTap> poisson_taps(int count, uint64_t seed);

/// The angle by which a rotated kernel turns at a pixel, [0, 2π): a hash of the pixel's place and the seed.
double rotation_at(int column, int row, uint64_t seed);

}  // namespace stairstep
