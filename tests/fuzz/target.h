// Fuzz targets: a function for each kind of input that comes from outside, which gives it any bytes.
//
// Bytes may be refused, by InputError or FailureError; any other exception, a crash, a sanitizer's report or a hang is a
// finding. What is accepted has the properties that the reader promises: numbers finite, indices that lead somewhere, the same
// value when written and read again. A target says what doesn't hold by `require`, whose Violation nothing catches.
//
// libfuzzer_main.cpp runs a target under libFuzzer, replay_test.cpp with the corpus and mutations of it.
#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "stimuli/error.h"

namespace stairstep::fuzz {

/// A property that doesn't hold.
struct Violation : std::logic_error {
    using std::logic_error::logic_error;
};

/// Throws Violation, saying `what` should have held.
inline void require(bool holds, const char* what) {
    if (!holds) throw Violation(what);
}

/// Does the work and says whether its input was accepted: false where it threw InputError or FailureError. What else it throws
/// goes on.
template <typename Work>
bool accepted(const Work& work) {
    try {
        work();
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Bytes as a file that readers find by a path; it lies in memory.
class InputFile {
  public:
    explicit InputFile(std::string_view bytes);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    int file_;
    std::filesystem::path path_;
};

struct Target {
    /// Its corpus is the folder corpus/NAME.
    const char* name;
    void (*run)(std::string_view input);
};

/// analysis/law: law.json.
void run_law(std::string_view input);
/// study: design.json.
void run_design(std::string_view input);
/// study: trials.csv.
void run_trials(std::string_view input);
/// study: intensities and responses, as QUEST's command takes them.
void run_answers(std::string_view input);
/// stimuli/io: a grid of stimuli.
void run_grid(std::string_view input);
/// stimuli/io: stimuli.csv.
void run_manifest(std::string_view input);
/// stimuli/io: a measured transfer.
void run_transfer(std::string_view input);
/// renderer: what the importer's process hands back.
void run_archive(std::string_view input);
/// renderer: Assimp's scene, made of the bytes, to the renderer's.
void run_scene(std::string_view input);

inline constexpr Target kTargets[] = {
    {"law", run_law},           {"design", run_design},   {"trials", run_trials},
    {"answers", run_answers},   {"grid", run_grid},       {"manifest", run_manifest},
    {"transfer", run_transfer}, {"archive", run_archive}, {"scene", run_scene},
};

}  // namespace stairstep::fuzz
