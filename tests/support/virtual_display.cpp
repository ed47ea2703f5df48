#include "tests/support/virtual_display.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace stairstep {

VirtualDisplay::VirtualDisplay() {
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) return;
    const std::string number_to = std::to_string(pipe_ends[1]);
    server_ = fork();
    if (server_ == 0) {
        // A test that crashes takes its server along.
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        close(pipe_ends[0]);
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        execlp("Xvfb", "Xvfb", "-displayfd", number_to.c_str(), "-screen", "0", "1280x1024x24", "-nolisten", "tcp",
               "-noreset", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(pipe_ends[1]);
    // The server writes its number, and a newline, once it takes connections; a server that ends closes the pipe.
    std::string number;
    for (char c = 0; read(pipe_ends[0], &c, 1) == 1 && c != '\n';) number += c;
    close(pipe_ends[0]);
    if (number.empty()) return;
    name_ = ":" + number;
    if (const char* display = std::getenv("DISPLAY")) former_ = display;
    setenv("DISPLAY", name_.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
    if (is_there()) former_.empty() ? unsetenv("DISPLAY") : setenv("DISPLAY", former_.c_str(), 1);
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
}

}  // namespace stairstep
