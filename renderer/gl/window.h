// A window with an OpenGL 4.5 core context: shows pictures, and says what its user does.
//
// Windows belong to the main thread: only there are they made, polled and destroyed. Drawing may happen in any thread
// where the context is current.
#pragma once

#include <utility>
#include <vector>

#include "renderer/gl/context.h"

struct GLFWwindow;

namespace stairstep::gl {

/// Keys by their place on a US keyboard. A key that types a character is that character, letters as capitals:
/// Key{'A'}.
enum class Key : int {
    space = ' ',
    escape = 256,
    enter = 257,
    tab = 258,
    backspace = 259,
    right = 262,
    left = 263,
    down = 264,
    up = 265,
};

/// A key that went down.
struct KeyPress {
    Key key;
    /// When it was read, on the clock of Window::now_s: as good as polls are frequent.
    double time_s;
};

class Window final : public Context {
  public:
    /// Throws FailureError where there is no display, or none with OpenGL 4.5.
    explicit Window(const WindowOptions& options);
    ~Window() override;

    /// Shows what was drawn into framebuffer 0; waits for the display's next refresh if swap_interval is 1.
    void swap();

    /// 1 (at first): a swap waits for the display's refresh. 0: it doesn't. The window must be current.
    void set_swap_interval(int refreshes);

    /// Takes in what happened since the last call: keys, resizing, the wish to close.
    void poll();

    /// Whether the user asked to close it, or close() did.
    bool is_closing() const;
    void close();

    /// Width and height of framebuffer 0 in pixels, as of the last poll; 0 while minimised.
    std::pair<int, int> framebuffer_size_px() const;

    bool is_down(Key key) const;

    /// The keys that went down since the last call, in order; a key held down counts once.
    std::vector<KeyPress> take_key_presses();

    /// Seconds on GLFW's monotonic clock.
    static double now_s();

    /// GLFW's own, for what reads the mouse or shows controls. Its key callback and user pointer are in use here:
    /// who sets a key callback calls the former one too.
    GLFWwindow* handle() const { return window_; }

  private:
    /// GLFW, initialised as long as there are windows.
    class Library {
      public:
        Library();
        ~Library();
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
    };

    void bind() override;
    void unbind() override;
    FunctionPointer address_of(const char* function) override;

    Library library_;
    GLFWwindow* window_ = nullptr;
    std::vector<KeyPress> presses_;
};

/// A window whose context is already current. Throws FailureError.
std::unique_ptr<Window> make_window(const WindowOptions& options = {});

}  // namespace stairstep::gl
