// What a wider filter costs: times against the radius, and the exponent p of time ∝ rᵖ over the larger radii.
//
// Two processor times: a picture's levels, and one value within the penumbra. The value is what the kernel costs: expected
// p = 0 for a box, whose columns add up in closed form, and at most 1 for a disk over a stair, which sums the columns under
// it. A picture's time also follows its penumbra, which grows with r until it fills the picture, and the number of levels
// in it, which falls from there on.
#pragma once

namespace stairstep {

/// Registers the rows radius/KERNEL/PATTERN/rRADIUS: box and disk, step, stair and line, a = 10 px, r = 5 … 640 px
/// doubling.
void register_radius_cost();

/// Prints the exponents of what has been run, from each row's fastest iterations, and the bar of one value's; nothing where
/// fewer than two of a series' larger radii have run.
void print_radius_exponents();

}  // namespace stairstep
