#include <gtest/gtest.h>

#include <type_traits>

#include "renderer/gl/context.h"
#include "renderer/gl/pass_timer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sample_counter.h"
#include "stimuli/error.h"
#include "tests/renderer/made_contexts.h"

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

class GlOn : public testing::TestWithParam<gl::ContextKind> {
  protected:
    void SetUp() override {
        if (const std::string reason = contexts_.why_not(GetParam()); !reason.empty()) GTEST_SKIP() << reason;
        context_ = gl::make_context(GetParam());
    }

    MadeContexts contexts_;
    std::unique_ptr<gl::Context> context_;
};

INSTANTIATE_TEST_SUITE_P(EveryKind, GlOn, testing::ValuesIn(kContextKinds),
                         [](const auto& info) { return std::string(gl::name(info.param)); });

// Of the triangle's legs of 48.5 px: pixels (x, y) with x + y ≤ 47.
TEST_P(GlOn, SamplesAreCounted) {
    constexpr uint64_t kTriangle = 48 * 49 / 2;
    gl::SampleCounter counter;
    EXPECT_EQ(counter.take(), std::nullopt);
    for (const int times : {1, 3, 2}) {
        for (int i = 0; i < times; ++i) {
            counter.start();
            triangle_picture();
            counter.stop();
        }
        // Of this nothing is counted.
        triangle_picture();
        EXPECT_EQ(counter.take(), times * kTriangle);
        EXPECT_EQ(counter.take(), std::nullopt);
    }
    gl::throw_on_error("counting samples");
}

TEST_P(GlOn, SaysWhatItRunsOn) {
    EXPECT_EQ(context_->describe().kind, GetParam());
    EXPECT_FALSE(context_->describe().renderer.empty());
    EXPECT_EQ(context_->describe().renderer, gl::renderer_name());
    EXPECT_GE(context_->describe().version.substr(0, 3), "4.5");
    EXPECT_TRUE(context_->describe().is_software || GetParam() != gl::ContextKind::osmesa);
}

TEST_P(GlOn, ATriangleCoversWhatItShould) {
    const std::vector<uint8_t> levels = triangle_picture();
    for (int y = 0; y < kPictureSide; ++y) {
        for (int x = 0; x < kPictureSide; ++x) {
            const size_t at = 4 * (static_cast<size_t>(y) * kPictureSide + x);
            const bool covered = x + y + 1 < kTriangleLeg_px;
            // Red and green are the pixel's centre over the side; GL lets a driver round either way.
            EXPECT_NEAR(levels[at], covered ? 255 * (x + 0.5) / kPictureSide : 0, covered ? 1 : 0) << x << "," << y;
            EXPECT_NEAR(levels[at + 1], covered ? 255 * (y + 0.5) / kPictureSide : 0, covered ? 1 : 0) << x << "," << y;
            EXPECT_EQ(levels[at + 2], covered ? 255 : 0) << x << "," << y;
        }
    }
}

TEST_P(GlOn, AMovedObjectIsOwnedOnce) {
    gl::Texture first = gl::make_texture(GL_RGBA8, 4, 4);
    const GLuint id = first.id();
    gl::Texture second = std::move(first);
    EXPECT_EQ(second.id(), id);
    EXPECT_EQ(first.id(), 0u);
}

TEST_P(GlOn, AShaderErrorCarriesTheDriversLog) {
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

TEST_P(GlOn, ALinkErrorIsOneToo) {
    EXPECT_THROW(gl::make_program(
                     "unlinked", {"#version 450 core\nvoid main() { gl_Position = vec4(0); }\n"},
                     {"#version 450 core\nvec3 missing();\nout vec4 c;\nvoid main() { c = vec4(missing(), 1); }\n"}),
                 FailureError);
}

TEST_P(GlOn, AWrongCallIsReportedOnceAndByName) {
    gl::Enable(0xdead);
    try {
        gl::throw_on_error("a test");
        FAIL() << "a wrong call went unnoticed";
    } catch (const FailureError& e) {
        EXPECT_NE(std::string(e.what()).find("invalid enum during a test"), std::string::npos) << e.what();
    }
    EXPECT_NO_THROW(gl::throw_on_error("nothing"));
}

TEST_P(GlOn, SizesTheDriverCantMakeAreRefused) {
    EXPECT_THROW(gl::make_texture(GL_RGBA8, 0, 4), FailureError);
    EXPECT_THROW(gl::make_texture(GL_RGBA8, 1 << 30, 4), FailureError);
}

TEST_P(GlOn, PassTimesAreMeasuredTwice) {
    gl::PassTimer timer;
    timer.start();
    triangle_picture();
    const gl::PassTime time = timer.stop();
    EXPECT_GT(time.cpu_ms, 0);
    EXPECT_GT(time.gpu_ms, 0);
    EXPECT_LE(time.gpu_ms, time.cpu_ms);
}

TEST_P(GlOn, APassIncludesThosePassesInIt) {
    gl::PassTimer outer;
    gl::PassTimer inner;
    outer.start();
    triangle_picture();
    inner.start();
    triangle_picture();
    const gl::PassTime first = inner.stop();
    inner.start();
    triangle_picture();
    const gl::PassTime second = inner.stop();
    const gl::PassTime all = outer.stop();
    EXPECT_GT(first.gpu_ms, 0);
    EXPECT_GT(second.gpu_ms, 0);
    EXPECT_GT(all.gpu_ms, first.gpu_ms + second.gpu_ms);
    EXPECT_GT(all.cpu_ms, first.cpu_ms + second.cpu_ms);
    EXPECT_LE(all.gpu_ms, all.cpu_ms);
    EXPECT_NO_THROW(gl::throw_on_error("nested passes"));
}

TEST_P(GlOn, APassGivenUpLeavesTheOthersTimed) {
    gl::PassTimer outer;
    outer.start();
    {
        gl::PassTimer inner;
        inner.start();
        triangle_picture();
    }
    triangle_picture();
    EXPECT_GT(outer.stop().gpu_ms, 0);
    outer.start();
    outer.start();
    triangle_picture();
    EXPECT_GT(outer.stop().gpu_ms, 0);
    EXPECT_NO_THROW(gl::throw_on_error("passes given up"));
}

}  // namespace
}  // namespace stairstep
