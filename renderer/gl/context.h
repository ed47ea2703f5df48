// Where OpenGL comes from. Nothing else in the renderer knows which kind of context is current.
#pragma once

#include <memory>
#include <string>

namespace stairstep::gl {

/// An OpenGL 4.5 core context. GL objects die before the context that was current when they were made.
class Context {
  public:
    Context() = default;
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it the calling thread's context and fills the function table.
    virtual void make_current() = 0;
};

/// Software rendering without a window or display (Mesa's OSMesa), already current. It has no picture of its
/// own: draw into a framebuffer object. Throws FailureError.
std::unique_ptr<Context> make_osmesa_context();

/// GL_RENDERER of the current context.
std::string renderer_name();

}  // namespace stairstep::gl
