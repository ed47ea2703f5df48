#include "renderer/gl/context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "renderer/gl/window.h"
#include "tests/renderer/made_contexts.h"

namespace stairstep {
namespace {

TEST(ContextKind, GoesByItsName) {
    for (const gl::ContextKind kind : kContextKinds) {
        EXPECT_EQ(gl::context_kind_named(std::string(gl::name(kind))), kind);
    }
    try {
        gl::context_kind_named("vulkan");
        FAIL() << "an unknown kind was accepted";
    } catch (const InputError& e) {
        const std::string message = e.what();
        for (const char* part : {"vulkan", "osmesa", "egl", "window"}) {
            EXPECT_NE(message.find(part), std::string::npos) << message;
        }
    }
}

TEST(SoftwareRenderer, IsKnownByItsName) {
    EXPECT_TRUE(gl::is_software_renderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(gl::is_software_renderer("softpipe"));
    EXPECT_TRUE(gl::is_software_renderer("Google SwiftShader"));
    EXPECT_FALSE(gl::is_software_renderer("NVIDIA GeForce RTX 3060/PCIe/SSE2"));
    EXPECT_FALSE(gl::is_software_renderer("AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49, 6.1.0-13-amd64)"));
    EXPECT_FALSE(gl::is_software_renderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
}

class ContextPair : public testing::TestWithParam<std::tuple<gl::ContextKind, gl::ContextKind>> {
  protected:
    void SetUp() override {
        for (const gl::ContextKind kind : {first(), second()}) {
            if (const std::string reason = contexts_.why_not(kind); !reason.empty()) GTEST_SKIP() << reason;
        }
    }
    static gl::ContextKind first() { return std::get<0>(GetParam()); }
    static gl::ContextKind second() { return std::get<1>(GetParam()); }

    MadeContexts contexts_;
};

INSTANTIATE_TEST_SUITE_P(EveryPair, ContextPair,
                         testing::Combine(testing::ValuesIn(kContextKinds), testing::ValuesIn(kContextKinds)),
                         [](const auto& info) {
                             return std::string(gl::name(std::get<0>(info.param))) + "_" +
                                    std::string(gl::name(std::get<1>(info.param)));
                         });

/// The level of the one pixel of a context's texture.
int red_level(const gl::Texture& texture) {
    std::array<uint8_t, 4> pixel{};
    gl::GetTextureImage(texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(pixel), pixel.data());
    gl::throw_on_error("reading a pixel");
    return pixel[0];
}

gl::Texture texture_of(uint8_t red) {
    const std::array<uint8_t, 4> pixel{red, 0, 0, 255};
    gl::Texture texture = gl::make_texture(GL_RGBA8, 1, 1);
    gl::TextureSubImage2D(texture.id(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    return texture;
}

TEST_P(ContextPair, DrawTheSamePicture) {
    std::unique_ptr<gl::Context> context = gl::make_context(first());
    const std::vector<uint8_t> one = triangle_picture();
    context = gl::make_context(second());
    const std::vector<uint8_t> other = triangle_picture();
    int most = 0;
    for (size_t i = 0; i < one.size(); ++i) most = std::max(most, std::abs(one[i] - other[i]));
    // Another driver may round the other way.
    EXPECT_LE(most, 1);
    EXPECT_EQ(*std::max_element(one.begin(), one.end()), 255);
}

TEST_P(ContextPair, TakeTurnsInOneThread) {
    const auto a = gl::make_context(first());
    std::optional<gl::Texture> of_a = texture_of(10);
    const auto b = gl::make_context(second());
    std::optional<gl::Texture> of_b = texture_of(20);
    // Both are their context's first texture: only the context tells them apart.
    ASSERT_EQ(of_a->id(), of_b->id());
    for (int turn = 0; turn < 5; ++turn) {
        a->make_current();
        EXPECT_EQ(red_level(*of_a), 10);
        EXPECT_EQ(triangle_picture()[2], 255);
        b->make_current();
        b->make_current();
        EXPECT_EQ(red_level(*of_b), 20);
        EXPECT_EQ(triangle_picture()[2], 255);
    }
    of_b.reset();
    a->make_current();
    of_a.reset();
}

TEST_P(ContextPair, OneSurvivesTheOthersEnd) {
    const auto survivor = gl::make_context(first());
    gl::Texture texture = texture_of(30);
    gl::make_context(second()).reset();
    survivor->make_current();
    EXPECT_EQ(red_level(texture), 30);
    {
        // Ends while it isn't current.
        const auto idle = gl::make_context(second());
        survivor->make_current();
    }
    EXPECT_EQ(red_level(texture), 30);
    EXPECT_EQ(triangle_picture()[2], 255);
}

TEST_P(ContextPair, DrawAtOnceInTwoThreads) {
    const auto a = gl::make_context(first());
    a->release();
    const auto b = gl::make_context(second());
    std::barrier both(2);
    std::vector<uint8_t> of_a;
    std::thread thread([&] {
        a->make_current();
        both.arrive_and_wait();
        for (int i = 0; i < 10; ++i) of_a = triangle_picture();
        a->release();
    });
    both.arrive_and_wait();
    std::vector<uint8_t> of_b;
    for (int i = 0; i < 10; ++i) of_b = triangle_picture();
    thread.join();
    int most = 0;
    for (size_t i = 0; i < of_b.size(); ++i) most = std::max(most, std::abs(of_a[i] - of_b[i]));
    EXPECT_LE(most, 1);
    EXPECT_EQ(of_b[2], 255);
}

/// In a process of its own, where a driver's library hasn't read the environment yet: exits with 1 and the error as
/// main would, with 0 if there was none.
[[noreturn]] void make_and_exit(gl::ContextKind kind) {
    int code = 0;
    try {
        gl::make_context(kind);
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        code = e.exit_code();
    }
    std::_Exit(code);
}

class ContextErrorDeathTest : public testing::Test {
  protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(ContextErrorDeathTest, AWindowWithoutADisplay) {
    EXPECT_EXIT(
        {
            unsetenv("DISPLAY");
            unsetenv("WAYLAND_DISPLAY");
            make_and_exit(gl::ContextKind::window);
        },
        testing::ExitedWithCode(1), "error: window: there is no display .*: set DISPLAY, or use --context osmesa");
}

TEST_F(ContextErrorDeathTest, AWindowOnADisplayThatIsNotThere) {
    EXPECT_EXIT(
        {
            setenv("DISPLAY", ":4711", 1);
            unsetenv("WAYLAND_DISPLAY");
            make_and_exit(gl::ContextKind::window);
        },
        testing::ExitedWithCode(1), "error: window: there is no display .*:4711");
}

TEST_F(ContextErrorDeathTest, EglWithoutADriver) {
    EXPECT_EXIT(
        {
            setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
            make_and_exit(gl::ContextKind::egl);
        },
        testing::ExitedWithCode(1), "error: EGL: nothing here gives .*default display.*use --context osmesa");
}

TEST_F(ContextErrorDeathTest, EglWhoseDriverIsTooOld) {
    EXPECT_EXIT(
        {
            setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
            setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
            make_and_exit(gl::ContextKind::egl);
        },
        testing::ExitedWithCode(1), "error: EGL: nothing here gives .*software.*4.5 core context is refused");
}

}  // namespace
}  // namespace stairstep
