#include "renderer/gl/pass_timer.h"

#include <algorithm>

namespace stairstep::gl {

void PassTimer::start() {
    Finish();
    start_ = std::chrono::steady_clock::now();
    BeginQuery(GL_TIME_ELAPSED, query_.id());
}

PassTime PassTimer::stop() {
    EndQuery(GL_TIME_ELAPSED);
    Finish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
    GLuint64 elapsed_ns = 0;
    GetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &elapsed_ns);
    // llvmpipe answers with the machine's uptime for a pass in which it draws no triangle.
    return {elapsed.count(), std::min(static_cast<double>(elapsed_ns) * 1e-6, elapsed.count())};
}

}  // namespace stairstep::gl
