// GLFW_INCLUDE_NONE keeps GL/gl.h out, whose GL 1.x declarations clash with glcorearb.h's.
#include "renderer/gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "stimuli/error.h"

namespace stairstep::gl {
namespace {

static_assert(static_cast<int>(Key::space) == GLFW_KEY_SPACE && static_cast<int>(Key{'A'}) == GLFW_KEY_A &&
              static_cast<int>(Key::escape) == GLFW_KEY_ESCAPE && static_cast<int>(Key::enter) == GLFW_KEY_ENTER &&
              static_cast<int>(Key::tab) == GLFW_KEY_TAB && static_cast<int>(Key::backspace) == GLFW_KEY_BACKSPACE &&
              static_cast<int>(Key::right) == GLFW_KEY_RIGHT && static_cast<int>(Key::left) == GLFW_KEY_LEFT &&
              static_cast<int>(Key::down) == GLFW_KEY_DOWN && static_cast<int>(Key::up) == GLFW_KEY_UP);

constexpr const char* kRemedy = "set DISPLAY to a display with OpenGL 4.5, or use --context osmesa";

/// Windows alive; the main thread's alone, as all of GLFW is.
int windows = 0;

/// What GLFW has to say of the last call that failed, which its error callback would be told too.
std::string glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

}  // namespace

Window::Library::Library() {
    if (windows == 0 && !glfwInit()) {
        throw FailureError("window", "there is no display (" + glfw_error() + ")",
                           "set DISPLAY, or use --context osmesa");
    }
    ++windows;
}

Window::Library::~Library() {
    if (--windows == 0) glfwTerminate();
}

Window::Window(const WindowOptions& options) : Context(ContextKind::window) {
    // GLFW makes a new window current to learn what it can do, which X11 ends the program for if EGL still has the thread.
    release_any();
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_VISIBLE, options.is_visible ? GLFW_TRUE : GLFW_FALSE);
    window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (!window_) {
        throw FailureError("window", "can't be made with an OpenGL 4.5 core context (" + glfw_error() + ")", kRemedy);
    }
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int /*scancode*/, int action, int /*modifiers*/) {
        if (action != GLFW_PRESS || key == GLFW_KEY_UNKNOWN) return;
        static_cast<Window*>(glfwGetWindowUserPointer(window))->presses_.push_back({Key{key}, now_s()});
    });
}

Window::~Window() {
    release();
    glfwDestroyWindow(window_);
}

void Window::bind() {
    glfwGetError(nullptr);  // an earlier call's
    glfwMakeContextCurrent(window_);
    if (glfwGetCurrentContext() != window_) {
        throw FailureError("window", "can't make its context current (" + glfw_error() + ")", kRemedy);
    }
}

void Window::unbind() {
    glfwMakeContextCurrent(nullptr);
}

FunctionPointer Window::address_of(const char* function) {
    return glfwGetProcAddress(function);
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

void Window::set_swap_interval(int refreshes) {
    glfwSwapInterval(refreshes);
}

void Window::poll() {
    glfwPollEvents();
}

bool Window::is_closing() const {
    return glfwWindowShouldClose(window_);
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

std::pair<int, int> Window::framebuffer_size_px() const {
    std::pair<int, int> size_px;
    glfwGetFramebufferSize(window_, &size_px.first, &size_px.second);
    return size_px;
}

bool Window::is_down(Key key) const {
    return glfwGetKey(window_, static_cast<int>(key)) == GLFW_PRESS;
}

std::vector<KeyPress> Window::take_key_presses() {
    return std::exchange(presses_, {});
}

double Window::now_s() {
    return glfwGetTime();
}

std::unique_ptr<Window> make_window(const WindowOptions& options) {
    auto window = std::make_unique<Window>(options);
    window->make_current();
    window->set_swap_interval(1);
    return window;
}

}  // namespace stairstep::gl
