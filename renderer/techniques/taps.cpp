#include "renderer/techniques/taps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/kernel.h"

namespace stairstep {
namespace {

constexpr std::array kModes{FilterMode::automatic, FilterMode::exact,   FilterMode::regular,
                            FilterMode::jittered,  FilterMode::poisson, FilterMode::rotated};

/// Which of the thrown sets.
constexpr uint64_t kPoissonSeed = 1;

bool in_disk(FilterMode filter) {
    return filter == FilterMode::poisson || filter == FilterMode::rotated;
}

int side_of(int count, const char* option) {
    const int side = static_cast<int>(std::lround(std::sqrt(std::clamp(count, 0, kMostTaps))));
    if (count < 1 || side * side != count) {
        throw InputError(std::string(option) + " " + std::to_string(count), "isn't a square number from 1 to 4096",
                         "use for example 25 or 64, or a Poisson disk");
    }
    return side;
}

}  // namespace

std::string_view name(FilterMode mode) {
    switch (mode) {
        case FilterMode::automatic: return "auto";
        case FilterMode::exact: return "exact";
        case FilterMode::regular: return "regular";
        case FilterMode::jittered: return "jittered";
        case FilterMode::poisson: return "poisson";
        case FilterMode::rotated: return "rotated";
    }
    return "";
}

FilterMode filter_mode_named(const std::string& wanted) {
    if (wanted == "sampled") return FilterMode::jittered;
    std::string names;
    for (const FilterMode mode : kModes) {
        if (wanted == name(mode)) return mode;
        names += (names.empty() ? "" : ", ") + std::string(name(mode));
    }
    throw InputError("--filter", "\"" + wanted + "\" is no filter", "use one of " + names);
}

TapSet::TapSet(FilterMode filter, int count, const char* option) : filter_(filter), count_(count) {
    std::vector<KernelTap> places;
    if (in_disk(filter)) {
        if (count < 1 || count > kMostTaps) {
            throw InputError(std::string(option) + " " + std::to_string(count), "isn't from 1 to 4096",
                             "use for example 25 or 64");
        }
        places = poisson_taps(count, kPoissonSeed);
    } else {
        places = box_taps(side_of(count, option));
    }
    std::vector<glm::vec2> taps;
    for (const KernelTap& tap : places) taps.push_back(static_cast<float>(reach()) * glm::vec2(tap.x, tap.y));
    taps_ = gl::make_buffer(std::as_bytes(std::span(taps)));
}

double TapSet::reach() const {
    return in_disk(filter_) ? axis_deviation(KernelShape::box) / axis_deviation(KernelShape::disk) : 1;
}

void TapSet::bind(const gl::Program& program, int index) const {
    const std::string which = "tap_sets[" + std::to_string(index) + "].";
    // A cell's side in units of the radius.
    const double cell = filter_ == FilterMode::jittered ? 2 / std::sqrt(count_) : 0;
    gl::set_uniform(program, (which + "count").c_str(), count_);
    gl::set_uniform(program, (which + "cell").c_str(), static_cast<float>(cell));
    gl::set_uniform(program, (which + "turned").c_str(), filter_ == FilterMode::rotated ? 1 : 0);
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(2 + index), taps_.id());
}

}  // namespace stairstep
