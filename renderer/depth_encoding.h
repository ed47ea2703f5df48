// How a shadow map stores depth: in how many bits, and linear in what.
//
// Under a directional light depths are linear along the light. Under a spot, with near and far the ends of the map's depths and z a
// depth between them,
//
//     reciprocal   d = far·(z − near)/(z·(far − near))     what a perspective projection gives: planes stay planes
//     linear       d = (z − near)/(far − near)
//
// A step s of d is a length of s·z²·(far − near)/(far·near) for the reciprocal, longest at the far end, s·(far − near)·far/near,
// and of s·(far − near) everywhere for the linear one. Stored in n bits, unsigned and normalised, depths are multiples of
// 1/(2ⁿ − 1), and OpenGL (4.5, section 2.3.5.2) may store either of the two around a depth: a receiver must leave that much to its
// own surface. Floats have smaller steps than what rounding has done to a depth before it is stored.
//
// Anchor: 16 bits, near 1, far 10, reciprocal → steps of 1.37 mm at the far end, if lengths are metres; linear 0.137 mm.
#pragma once

#include <string>
#include <string_view>

namespace stairstep {

enum class DepthFormat { unorm16, unorm24, float32 };

enum class SpotDepth { reciprocal, linear };

struct DepthEncoding {
    DepthFormat format = DepthFormat::float32;
    /// Of spots; what a directional light's map stores is linear.
    SpotDepth spot = SpotDepth::reciprocal;

    bool operator==(const DepthEncoding&) const = default;
};

int bits_of(DepthFormat format);

/// Throws InputError that lists what there is, 16, 24 and 32: the last is the float's.
DepthFormat depth_format_of_bits(int bits);

std::string_view name(SpotDepth depth);
/// Throws InputError that lists the names there are.
SpotDepth spot_depth_named(const std::string& name);

/// Most by which a stored depth in [0, 1] differs from what was to be stored: 1/65535, 1/16777215, and 0 for floats.
double depth_step(DepthFormat format);

/// The least far end beyond `last`, the deepest caster, with which a spot's last caster isn't stored as the end itself, which is an
/// empty texel's: for 16 bits 1.03 last where near is last/1000, its least. Of a linear depth any clearance is far more than a step.
double least_farthest(const DepthEncoding& encoding, double near, double last);

}  // namespace stairstep
