#include "renderer/gl/context.h"

#include "renderer/gl/functions.h"

namespace stairstep::gl {

std::string renderer_name() {
    return reinterpret_cast<const char*>(GetString(GL_RENDERER));
}

}  // namespace stairstep::gl
