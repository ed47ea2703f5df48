// Damaged copies of inputs, for programs that libFuzzer doesn't drive.
#pragma once

#include <span>
#include <string>

#include "stimuli/random.h"

namespace stairstep::fuzz {

/// One of the inputs with one to four of these done to it: a bit flipped, a byte set, a stretch removed, repeated or taken from
/// another input, the end cut off, a number replaced by one at the edge of what readers take. The same state of `random` gives
/// the same bytes. At least one input; the result has at most `kLongestMutation` bytes.
std::string mutation(std::span<const std::string> inputs, Random& random);

inline constexpr size_t kLongestMutation = 8192;

}  // namespace stairstep::fuzz
