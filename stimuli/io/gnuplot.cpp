#include "stimuli/io/gnuplot.h"

#include <cstdlib>
#include <filesystem>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

/// Quiet axes, the data in front.
constexpr const char* kStyle =
    "set border 3 lc rgb '#555555'\nset tics nomirror out tc rgb '#333333'\n"
    "set grid ytics lc rgb '#e6e6e6' lt 1 lw 0.6\n";

std::string shell_quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

std::string draw_svg(const std::string& script, int width_px, int height_px) {
    const TemporaryFolder folder;
    write_file(folder.path() / "figure.gp", "set terminal svg size " + std::to_string(width_px) + "," +
                                                std::to_string(height_px) +
                                                " font 'Helvetica,13' background '#ffffff'\n"
                                                "set output 'figure.svg'\nset encoding utf8\n" +
                                                kStyle + script);
    const std::string command = "cd " + shell_quoted(folder.path().string()) + " && gnuplot figure.gp 2>errors.txt";
    const int status = std::system(command.c_str());
    const fs::path figure = folder.path() / "figure.svg";
    if (status != 0 || !fs::exists(figure)) {
        throw FailureError("gnuplot", "could not draw a figure (" + read_file(folder.path() / "errors.txt") + ")",
                           "install gnuplot-nox");
    }
    return read_file(figure);
}

std::string gnuplot_version() {
    const TemporaryFolder folder;
    const fs::path answer = folder.path() / "version.txt";
    if (std::system(("gnuplot --version >" + shell_quoted(answer.string()) + " 2>/dev/null").c_str()) != 0) {
        throw FailureError("gnuplot", "could not be started", "install gnuplot-nox");
    }
    std::string version = read_file(answer);
    while (version.ends_with('\n')) version.pop_back();
    return version;
}

}  // namespace stairstep
