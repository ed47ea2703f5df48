// How many samples pass the depth test, counted by GL and read when they are wanted: the same commands give the same counts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gl/objects.h"

namespace stairstep::gl {

/// Counts what is drawn between start and stop, as often as they are called (GL_SAMPLES_PASSED). GL counts for one at a time.
class SampleCounter {
  public:
    void start();
    void stop();

    /// The sum of all that was counted since the last take; nullopt if nothing was. Waits for the GPU to have drawn it.
    std::optional<uint64_t> take();

  private:
    /// Made when they are first needed; those up to used_ hold counts.
    std::vector<Query> queries_;
    size_t used_ = 0;
};

}  // namespace stairstep::gl
