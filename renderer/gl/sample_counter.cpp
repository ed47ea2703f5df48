#include "renderer/gl/sample_counter.h"

namespace stairstep::gl {

void SampleCounter::start() {
    if (used_ == queries_.size()) queries_.push_back(make_sample_query());
    BeginQuery(GL_SAMPLES_PASSED, queries_[used_].id());
}

void SampleCounter::stop() {
    EndQuery(GL_SAMPLES_PASSED);
    ++used_;
}

std::optional<uint64_t> SampleCounter::take() {
    if (used_ == 0) return std::nullopt;
    uint64_t sum = 0;
    for (size_t i = 0; i < used_; ++i) {
        GLuint64 samples = 0;
        GetQueryObjectui64v(queries_[i].id(), GL_QUERY_RESULT, &samples);
        sum += samples;
    }
    used_ = 0;
    return sum;
}

}  // namespace stairstep::gl
