#include <gtest/gtest.h>

#include <array>
#include <type_traits>

#include "renderer/gl/context.h"
#include "renderer/gl/pass_timer.h"
#include "renderer/gl/program.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

template <typename T>
constexpr bool kMoveOnly = std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
                           !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(kMoveOnly<gl::Texture> && kMoveOnly<gl::Buffer> && kMoveOnly<gl::VertexArray> &&
              kMoveOnly<gl::Framebuffer> && kMoveOnly<gl::Query> && kMoveOnly<gl::Shader> && kMoveOnly<gl::Program>);

TEST(Gl, AMissingFunctionIsNamed) {
    try {
        gl::load_functions([](const char*) -> gl::FunctionPointer { return nullptr; });
        FAIL() << "an empty driver was accepted";
    } catch (const FailureError& e) {
        EXPECT_NE(std::string(e.what()).find("glAttachShader"), std::string::npos) << e.what();
    }
}

class GlWithContext : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

TEST_F(GlWithContext, SaysWhatItRunsOn) {
    EXPECT_FALSE(gl::renderer_name().empty());
}

TEST_F(GlWithContext, AMovedObjectIsOwnedOnce) {
    gl::Texture first = gl::make_texture(GL_RGBA8, 4, 4);
    const GLuint id = first.id();
    gl::Texture second = std::move(first);
    EXPECT_EQ(second.id(), id);
    EXPECT_EQ(first.id(), 0u);
}

TEST_F(GlWithContext, AShaderErrorCarriesTheDriversLog) {
    try {
        gl::make_program("broken", {"#version 450 core\nvoid main() { nonsense(); }\n"},
                         {"#version 450 core\nvoid main() {}\n"});
        FAIL() << "a broken shader compiled";
    } catch (const FailureError& e) {
        const std::string message = e.what();
        EXPECT_NE(message.find("broken vertex shader"), std::string::npos) << message;
        EXPECT_NE(message.find("nonsense"), std::string::npos) << message;
    }
}

TEST_F(GlWithContext, ALinkErrorIsOneToo) {
    EXPECT_THROW(gl::make_program(
                     "unlinked", {"#version 450 core\nvoid main() { gl_Position = vec4(0); }\n"},
                     {"#version 450 core\nvec3 missing();\nout vec4 c;\nvoid main() { c = vec4(missing(), 1); }\n"}),
                 FailureError);
}

TEST_F(GlWithContext, AWrongCallIsReportedOnceAndByName) {
    gl::Enable(0xdead);
    try {
        gl::throw_on_error("a test");
        FAIL() << "a wrong call went unnoticed";
    } catch (const FailureError& e) {
        EXPECT_NE(std::string(e.what()).find("invalid enum during a test"), std::string::npos) << e.what();
    }
    EXPECT_NO_THROW(gl::throw_on_error("nothing"));
}

TEST_F(GlWithContext, SizesTheDriverCantMakeAreRefused) {
    EXPECT_THROW(gl::make_texture(GL_RGBA8, 0, 4), FailureError);
    EXPECT_THROW(gl::make_texture(GL_RGBA8, 1 << 30, 4), FailureError);
}

TEST_F(GlWithContext, PassTimesAreMeasuredTwice) {
    const gl::Texture texture = gl::make_texture(GL_RGBA8, 2048, 2048);
    const gl::Framebuffer framebuffer = gl::make_framebuffer(texture.id(), 0);
    gl::PassTimer timer;
    timer.start();
    const std::array<float, 4> red{1, 0, 0, 1};
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, red.data());
    const gl::PassTime time = timer.stop();
    EXPECT_GT(time.cpu_ms, 0);
    EXPECT_GE(time.gpu_ms, 0);
    EXPECT_LE(time.gpu_ms, time.cpu_ms);
}

}  // namespace
}  // namespace stairstep
