// The one file that includes GL/osmesa.h: it drags in GL/gl.h, whose GL 1.x declarations clash with
// glcorearb.h's, so nothing of functions.h is seen here.
#include <GL/osmesa.h>

#include <array>
#include <cstdint>

#include "renderer/gl/context.h"
#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

class OsmesaContext final : public Context {
  public:
    OsmesaContext() : Context(ContextKind::osmesa) {
        constexpr std::array attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        4,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        5,
                                        0};
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (!context_) {
            throw FailureError("OSMesa", "can't make an OpenGL 4.5 core context", "install libosmesa6 22 or newer");
        }
    }

    ~OsmesaContext() override {
        release();
        OSMesaDestroyContext(context_);
    }

  private:
    void bind() override {
        if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
            throw FailureError("OSMesa", "can't make its context current", "check the installation of libosmesa6");
        }
    }

    void unbind() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

    FunctionPointer address_of(const char* function) override {
        return reinterpret_cast<FunctionPointer>(OSMesaGetProcAddress(function));
    }

    // OSMesa wants a default framebuffer, though nothing is ever drawn into it.
    static constexpr int kSide = 4;
    std::array<uint8_t, kSide * kSide * 4> pixels_{};
    OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() {
    auto context = std::make_unique<OsmesaContext>();
    context->make_current();
    return context;
}

}  // namespace stairstep::gl
