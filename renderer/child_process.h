// Work that may crash or never end, done where that harms nothing: in a child process with bounds.
//
// Importers of model files are many and old: a flipped bit makes some of them write where they must not, abort, or loop
// for ever, which no check of ours can tell beforehand.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace stairstep {

struct ChildLimits {
    /// Bytes that the child may map beyond what the process has already.
    size_t memory = 0;
    /// Processor time, seconds; on the clock four times that, as the machine may be busy.
    int cpu_s = 1;
};

struct ChildOutcome {
    enum class End { finished, crashed, out_of_time } end = End::finished;
    /// What the work returned, where it finished.
    std::string output;
};

/// Does the work in a child with a copy of this process's memory and only the calling thread; the work changes nothing
/// here and what it prints is lost. An exception that leaves the work is a crash. Throws FailureError where no process
/// can be made.
ChildOutcome run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace stairstep
