#include "renderer/gl/functions.h"

#include <string>

#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

const char* error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM: return "invalid enum";
        case GL_INVALID_VALUE: return "invalid value";
        case GL_INVALID_OPERATION: return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
        case GL_OUT_OF_MEMORY: return "out of memory";
    }
    return "unknown error";
}

}  // namespace

#define STAIRSTEP_DEFINE(name) constinit thread_local decltype(&::gl##name) name = nullptr;
STAIRSTEP_GL_FUNCTIONS(STAIRSTEP_DEFINE)
#undef STAIRSTEP_DEFINE

void load_functions(const std::function<FunctionPointer(const char*)>& address_of) {
    const auto load = [&](const char* name) {
        const FunctionPointer address = address_of(name);
        if (!address) {
            throw FailureError("OpenGL", std::string("this driver has no ") + name, "use one with OpenGL 4.5");
        }
        return address;
    };
#define STAIRSTEP_LOAD(name) name = reinterpret_cast<decltype(&::gl##name)>(load("gl" #name));
    STAIRSTEP_GL_FUNCTIONS(STAIRSTEP_LOAD)
#undef STAIRSTEP_LOAD
}

void throw_on_error(const char* during) {
    const GLenum error = GetError();
    if (error == GL_NO_ERROR) return;
    // A driver may keep several flags; leave none behind to be blamed on the next caller. A lost context
    // reports errors for ever, hence the bound.
    for (int i = 0; i < 16 && GetError() != GL_NO_ERROR; ++i) {
    }
    const char* remedy = error == GL_OUT_OF_MEMORY ? "use a smaller picture or shadow map" : "please report this";
    throw FailureError("OpenGL", std::string(error_name(error)) + " during " + during, remedy);
}

}  // namespace stairstep::gl
