// Where OpenGL comes from. Nothing else in the renderer knows which kind of context is current.
//
// Contexts are per thread, and so is the function table: a thread has at most one current context, whatever its kind,
// and its table is that context's. Kinds can be made current in turn, also when they come from different drivers.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace stairstep::gl {

/// osmesa: Mesa's software rendering, without display or driver; the same picture everywhere.
/// egl: the GPU without a display, or Mesa's software device where there is no GPU.
/// window: what the display's driver gives a window, visible or hidden.
enum class ContextKind { osmesa, egl, window };

/// "osmesa", "egl" or "window".
std::string_view name(ContextKind kind);

/// The kind of this name. Throws InputError that lists the names.
ContextKind context_kind_named(const std::string& name);

/// What draws, as the driver says it.
struct ContextDescription {
    ContextKind kind = ContextKind::osmesa;
    /// GL_RENDERER, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer;
    /// GL_VERSION, such as "4.5 (Core Profile) Mesa 22.3.6".
    std::string version;
    /// Whether the CPU draws, by is_software_renderer: times then say nothing of a GPU.
    bool is_software = false;
};

/// Whether a GL_RENDERER is one of the known renderers that run on the CPU: Mesa's llvmpipe, softpipe and swrast,
/// SwiftShader. A GPU's driver may also name LLVM: "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, …)" is none.
bool is_software_renderer(std::string_view renderer);

/// Any GL function; its real type is the caller's business.
using FunctionPointer = void (*)();

/// An OpenGL 4.5 core context. GL objects die before the context that was current when they were made, and while it
/// is current. A context itself dies in the thread where it is current, or where none has it.
class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes it the calling thread's context, in place of any other, and fills the thread's function table. A context is
    /// current in one thread at a time. Throws FailureError.
    void make_current();

    /// Leaves the calling thread without a context, if this one is current in it; another thread may then take it.
    void release();

    /// As it was when it first became current, which the functions that make contexts see to.
    const ContextDescription& describe() const { return description_; }

  protected:
    explicit Context(ContextKind kind) { description_.kind = kind; }

    /// Leaves the calling thread without a context.
    static void release_any();

  private:
    virtual void bind() = 0;
    virtual void unbind() = 0;
    virtual FunctionPointer address_of(const char* function) = 0;

    ContextDescription description_;
};

/// What a window is like at first. Nothing but a window reads it.
struct WindowOptions {
    std::string title = "Stairstep";
    /// Of the drawable area, in screen coordinates: pixels but where the desktop scales. At least 1.
    int width = 1280;
    int height = 720;
    /// A hidden window is for drawing into framebuffer objects; what its own picture holds is undefined.
    bool is_visible = false;
};

/// A context of this kind, already current. Throws FailureError that says what was tried and what would do; the thread
/// may then be without a context.
std::unique_ptr<Context> make_context(ContextKind kind, const WindowOptions& window = {});

/// Software rendering without a window or display (Mesa's OSMesa), already current. It has no picture of its
/// own: draw into a framebuffer object. Throws FailureError.
std::unique_ptr<Context> make_osmesa_context();

/// Rendering without a window or display on the first device of EGL's that can, GPUs before software, already current.
/// Where devices can't be listed (EGL_EXT_device_enumeration, EGL_EXT_platform_device), EGL's surfaceless platform and
/// then its default display are tried. It has no picture of its own. Throws FailureError that lists what was tried.
std::unique_ptr<Context> make_egl_context();

/// GL_RENDERER of the current context.
std::string renderer_name();

}  // namespace stairstep::gl
