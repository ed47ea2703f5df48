#include "stimuli/io/program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <new>

#include "stimuli/error.h"

namespace stairstep {
namespace {

/// An error is one line, whatever a library put into its message.
std::string one_line(std::string text) {
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

int fail(int exit_code, const std::string& message) {
    std::fprintf(stderr, "error: %s\n", one_line(message).c_str());
    return exit_code;
}

}  // namespace

int run_program(CLI::App& app, int argc, char** argv) {
    app.set_version_flag("--version", STAIRSTEP_VERSION);
    try {
        app.parse(argc, argv);
        std::cout.flush();
        if (!std::cout) return fail(1, "standard output: can't be written: check where it goes");
        return 0;
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& e) {
        return fail(2, std::string("command line: ") + e.what() + ": see " + app.get_name() + " --help");
    } catch (const Error& e) {
        return fail(e.exit_code(), e.what());
    } catch (const std::bad_alloc&) {
        return fail(1, "memory: there is not enough for this: ask for less at a time");
    } catch (const std::exception& e) {
        return fail(1, std::string("internal: ") + e.what() + ": please report this");
    }
}

void warn(const char* subject, const char* message) {
    std::fprintf(stderr, "warning: %s: %s\n", subject, message);
}

}  // namespace stairstep
