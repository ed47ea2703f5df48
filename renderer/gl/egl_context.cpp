// The one file that includes EGL's headers.
//
// A GPU without a display is reached through the device platform: EGL_EXT_device_enumeration lists the devices,
// EGL_EXT_platform_device makes a display of one. Mesa's software renderer is a device too
// (EGL_MESA_device_software). Extension texts: the Khronos EGL registry.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

#include "renderer/gl/context.h"
#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

const char* error_name(EGLint error) {
    switch (error) {
        case EGL_SUCCESS: return "no reason given";
        case EGL_NOT_INITIALIZED: return "EGL_NOT_INITIALIZED";
        case EGL_BAD_ACCESS: return "EGL_BAD_ACCESS";
        case EGL_BAD_ALLOC: return "EGL_BAD_ALLOC";
        case EGL_BAD_ATTRIBUTE: return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_CONFIG: return "EGL_BAD_CONFIG";
        case EGL_BAD_CONTEXT: return "EGL_BAD_CONTEXT";
        case EGL_BAD_DISPLAY: return "EGL_BAD_DISPLAY";
        case EGL_BAD_MATCH: return "EGL_BAD_MATCH";
        case EGL_BAD_PARAMETER: return "EGL_BAD_PARAMETER";
        case EGL_BAD_SURFACE: return "EGL_BAD_SURFACE";
        case EGL_CONTEXT_LOST: return "EGL_CONTEXT_LOST";
    }
    return "an unknown EGL error";
}

/// What went wrong on one of several ways to a context: a reason to try the next.
struct Refusal {
    std::string reason;
};

[[noreturn]] void refuse(const std::string& call) {
    throw Refusal{call + " says " + error_name(eglGetError())};
}

/// Whether a space-separated list, null where EGL has none, holds this word.
bool lists(const char* extensions, const char* extension) {
    std::istringstream words(extensions ? extensions : "");
    const std::istream_iterator<std::string> end;
    return std::find(std::istream_iterator<std::string>(words), end, extension) != end;
}

template <typename Function>
Function extension_function(const char* function) {
    return reinterpret_cast<Function>(eglGetProcAddress(function));
}

/// A display, initialised as long as someone uses it. EGL hands out the same display each time but doesn't count who
/// initialised it: the first eglTerminate would end everyone's contexts.
class Display {
  public:
    explicit Display(EGLDisplay display) : display_(display) {
        const std::scoped_lock lock(guard());
        if (!eglInitialize(display, nullptr, nullptr)) refuse("eglInitialize");
        ++users()[display];
    }
    ~Display() {
        const std::scoped_lock lock(guard());
        if (--users()[display_] == 0) eglTerminate(display_);
    }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    EGLDisplay id() const { return display_; }

  private:
    static std::mutex& guard() {
        static std::mutex mutex;
        return mutex;
    }
    static std::map<EGLDisplay, int>& users() {
        static std::map<EGLDisplay, int> counts;
        return counts;
    }

    EGLDisplay display_;
};

class EglContext final : public Context {
  public:
    explicit EglContext(EGLDisplay display) : Context(ContextKind::egl), display_(display) {
        if (!eglBindAPI(EGL_OPENGL_API)) refuse("eglBindAPI for OpenGL");
        const bool needs_surface = !lists(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
        const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                           needs_surface ? EGL_PBUFFER_BIT : 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint configs = 0;
        if (!eglChooseConfig(display, wanted.data(), &config, 1, &configs)) refuse("eglChooseConfig");
        if (configs == 0) throw Refusal{"it draws no OpenGL"};

        constexpr std::array<EGLint, 7> kCore45{
            EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        if (needs_surface) {
            constexpr std::array<EGLint, 5> kSmall{EGL_WIDTH, 4, EGL_HEIGHT, 4, EGL_NONE};
            surface_ = eglCreatePbufferSurface(display, config, kSmall.data());
            if (surface_ == EGL_NO_SURFACE) refuse("eglCreatePbufferSurface");
        }
        context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, kCore45.data());
        if (context_ == EGL_NO_CONTEXT) {
            const EGLint error = eglGetError();
            destroy_surface();
            throw Refusal{std::string("an OpenGL 4.5 core context is refused with ") + error_name(error)};
        }
    }

    ~EglContext() override {
        release();
        eglDestroyContext(display_.id(), context_);
        destroy_surface();
    }

  private:
    void bind() override {
        // The API is each thread's own, and OpenGL ES at first.
        if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_.id(), surface_, surface_, context_)) {
            throw FailureError("EGL", std::string("can't make its context current: ") + error_name(eglGetError()),
                               "use it in one thread at a time, or use --context osmesa");
        }
    }

    void unbind() override {
        eglBindAPI(EGL_OPENGL_API);
        eglMakeCurrent(display_.id(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    FunctionPointer address_of(const char* function) override { return eglGetProcAddress(function); }

    void destroy_surface() {
        if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_.id(), surface_);
    }

    Display display_;
    EGLSurface surface_ = EGL_NO_SURFACE;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// One way to a display, and its name in errors.
struct Candidate {
    std::string name;
    EGLenum platform;  ///< EGL_NONE for EGL's default display
    void* native;
};

/// The devices, hardware first, in EGL's order otherwise. Empty where EGL can't list them.
std::vector<Candidate> devices(const char* extensions) {
    const bool enumerates = lists(extensions, "EGL_EXT_device_enumeration") || lists(extensions, "EGL_EXT_device_base");
    const auto query_devices = extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = extension_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    EGLint count = 0;
    if (!enumerates || !lists(extensions, "EGL_EXT_platform_device") || !query_devices ||
        !query_devices(0, nullptr, &count) || count < 1) {
        return {};
    }
    std::vector<EGLDeviceEXT> found(static_cast<size_t>(count));
    if (!query_devices(count, found.data(), &count)) return {};
    found.resize(static_cast<size_t>(count));

    std::vector<Candidate> hardware;
    std::vector<Candidate> software;
    for (size_t i = 0; i < found.size(); ++i) {
        const char* traits = query_string ? query_string(found[i], EGL_EXTENSIONS) : nullptr;
        const bool is_software = lists(traits, "EGL_MESA_device_software");
        (is_software ? software : hardware)
            .push_back({"device " + std::to_string(i + 1) + " of " + std::to_string(found.size()) +
                            (is_software ? " (software)" : " (hardware)"),
                        EGL_PLATFORM_DEVICE_EXT, found[i]});
    }
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

std::vector<Candidate> candidates() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Candidate> all = devices(extensions);
    if (lists(extensions, "EGL_MESA_platform_surfaceless")) {
        all.push_back({"surfaceless platform", EGL_PLATFORM_SURFACELESS_MESA, nullptr});
    }
    all.push_back({"default display", EGL_NONE, nullptr});
    return all;
}

EGLDisplay display_of(const Candidate& candidate) {
    const auto platform_display = extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    EGLDisplay display = EGL_NO_DISPLAY;
    if (candidate.platform == EGL_NONE) {
        display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    } else if (platform_display) {
        display = platform_display(candidate.platform, candidate.native, nullptr);
    }
    if (display == EGL_NO_DISPLAY) throw Refusal{"it has no display"};
    return display;
}

}  // namespace

std::unique_ptr<Context> make_egl_context() {
    std::string tried;
    for (const Candidate& candidate : candidates()) {
        try {
            auto context = std::make_unique<EglContext>(display_of(candidate));
            context->make_current();
            return context;
        } catch (const Refusal& refusal) {
            tried += (tried.empty() ? "" : "; ") + candidate.name + ": " + refusal.reason;
        } catch (const FailureError& e) {
            tried += (tried.empty() ? "" : "; ") + candidate.name + ": " + e.what();
        }
    }
    throw FailureError("EGL", "nothing here gives an OpenGL 4.5 core context (" + tried + ")",
                       "install the GPU's driver with its EGL library, or libegl-mesa0, or use --context osmesa");
}

}  // namespace stairstep::gl
