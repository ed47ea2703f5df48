// A display of the test's own (Xvfb), so that windows open alike on a desktop and on a machine without one.
#pragma once

#include <sys/types.h>

#include <string>

namespace stairstep {

/// Xvfb on a free display as long as this lives; DISPLAY names it meanwhile.
class VirtualDisplay {
  public:
    VirtualDisplay();
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// False where Xvfb isn't installed or doesn't start.
    bool is_there() const { return !name_.empty(); }

  private:
    pid_t server_ = -1;
    /// ":99", empty if there is none.
    std::string name_;
    std::string former_;
};

}  // namespace stairstep
