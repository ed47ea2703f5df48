#include "study/answer_stream.h"

namespace stairstep {

AnswerStream::AnswerStream(std::FILE* file, std::string source)
    : rows_(file, std::move(source)), intensity_(rows_.column("intensity")), response_(rows_.column("response")) {}

std::optional<Answer> AnswerStream::next() {
    if (!rows_.next()) return std::nullopt;
    const double response = rows_.number(response_);
    if (response != 0 && response != 1) {
        rows_.reject(response_, "\"" + std::string(rows_.text(response_)) + "\" is neither 0 nor 1",
                     "write 1 for a right answer, 0 for a wrong one");
    }
    return Answer{rows_.number(intensity_), response == 1};
}

}  // namespace stairstep
