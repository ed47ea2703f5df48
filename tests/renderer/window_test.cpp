#include "renderer/gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <functional>
#include <thread>

#include "renderer/gl/functions.h"
#include "tests/support/virtual_display.h"

// Last, for its macros.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>

// As GLFW/glfw3native.h declares them, which wants the headers of all of X11's extensions.
extern "C" {
Display* glfwGetX11Display();
Window glfwGetX11Window(GLFWwindow* window);
}

namespace stairstep {
namespace {

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        if (!display_.is_there()) GTEST_SKIP() << "no windows here: Xvfb doesn't start: install xvfb";
        window_ = gl::make_window({.title = "test", .width = 200, .height = 100, .is_visible = true});
    }

    /// Polls until this holds, at most some seconds: the display answers when it likes.
    bool comes_true(const std::function<bool()>& condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (!condition() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            window_->poll();
        }
        return condition();
    }

    /// Sends what the server would when a key goes down or up.
    void send_key(KeySym symbol, int type) {
        Display* display = glfwGetX11Display();
        XEvent event{};
        event.xkey.type = type;
        event.xkey.display = display;
        event.xkey.window = glfwGetX11Window(window_->handle());
        event.xkey.root = DefaultRootWindow(display);
        event.xkey.keycode = XKeysymToKeycode(display, symbol);
        event.xkey.same_screen = True;
        event.xkey.time = ++time_ms_;
        XSendEvent(display, event.xkey.window, True, KeyPressMask, &event);
        XFlush(display);
    }

    VirtualDisplay display_;
    std::unique_ptr<gl::Window> window_;
    Time time_ms_ = 1000;
};

TEST_F(WindowTest, HasTheSizeAskedFor) {
    EXPECT_EQ(window_->framebuffer_size_px(), (std::pair{200, 100}));
}

TEST_F(WindowTest, FollowsAResize) {
    glfwSetWindowSize(window_->handle(), 320, 240);
    EXPECT_TRUE(comes_true([&] { return window_->framebuffer_size_px() == std::pair{320, 240}; }));
}

TEST_F(WindowTest, ClosesWhenAsked) {
    EXPECT_FALSE(window_->is_closing());
    window_->close();
    EXPECT_TRUE(window_->is_closing());
}

TEST_F(WindowTest, KeysComeInOrder) {
    const double before_s = gl::Window::now_s();
    send_key(XK_a, KeyPress);
    send_key(XK_Escape, KeyPress);
    EXPECT_TRUE(comes_true([&] { return window_->is_down(gl::Key::escape); }));
    EXPECT_TRUE(window_->is_down(gl::Key{'A'}));
    EXPECT_FALSE(window_->is_down(gl::Key::space));
    const auto presses = window_->take_key_presses();
    ASSERT_EQ(presses.size(), 2u);
    EXPECT_EQ(presses[0].key, gl::Key{'A'});
    EXPECT_EQ(presses[1].key, gl::Key::escape);
    EXPECT_GE(presses[0].time_s, before_s);
    EXPECT_GE(presses[1].time_s, presses[0].time_s);
    EXPECT_TRUE(window_->take_key_presses().empty());
    send_key(XK_a, KeyRelease);
    EXPECT_TRUE(comes_true([&] { return !window_->is_down(gl::Key{'A'}); }));
}

TEST_F(WindowTest, ShowsWhatWasDrawn) {
    const std::array<float, 4> colour{1, 0.2F, 0, 1};
    for (int frame = 0; frame < 2; ++frame) {
        gl::ClearNamedFramebufferfv(0, GL_COLOR, 0, colour.data());
        window_->swap();
    }
    gl::Finish();
    Display* display = glfwGetX11Display();
    unsigned long shown = 0;
    EXPECT_TRUE(comes_true([&] {
        XImage* image = XGetImage(display, glfwGetX11Window(window_->handle()), 100, 50, 1, 1, AllPlanes, ZPixmap);
        if (!image) return false;
        shown = XGetPixel(image, 0, 0) & 0xffffff;
        XDestroyImage(image);
        return shown == 0xff3300;
    })) << std::hex
        << shown;
}

TEST_F(WindowTest, AnotherWindowOutlivesIt) {
    auto other = gl::make_window({.width = 50, .height = 40});
    window_.reset();
    EXPECT_EQ(other->framebuffer_size_px(), (std::pair{50, 40}));
    EXPECT_FALSE(gl::renderer_name().empty());
}

}  // namespace
}  // namespace stairstep
