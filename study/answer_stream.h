// Answers as the CSV that `stairstep-study quest` takes: the columns intensity and response, others ignored.
#pragma once

#include <cstdio>
#include <optional>
#include <string>

#include "stimuli/io/csv.h"

namespace stairstep {

struct Answer {
    /// Finite, in the unit of the engine that takes it.
    double intensity = 0;
    bool correct = false;
};

/// Reads them one by one, for more than memory should hold.
class AnswerStream {
  public:
    /// Reads the header. `file` stays the caller's and has to outlive the stream. Throws InputError naming `source` and what
    /// is missing or malformed; so does `next`, naming the line.
    AnswerStream(std::FILE* file, std::string source);

    /// The next answer; nullopt after the last. A response is 0 (wrong) or 1 (right).
    std::optional<Answer> next();

    /// Bytes read so far.
    long bytes() const { return rows_.bytes(); }

  private:
    CsvStream rows_;
    size_t intensity_;
    size_t response_;
};

}  // namespace stairstep
