#include "renderer/bench/configuration.h"

#include <algorithm>
#include <array>

namespace stairstep::bench {
namespace {

constexpr std::array<std::optional<int>, 6> kSides{512, 1024, 2048, 4096, 8192, std::nullopt};
constexpr std::array kTaps{9, 25, 49};

bool is_pcss(const Configuration& configuration) {
    return configuration.entry == "pcss";
}

bool is_prefiltered(const Configuration& configuration) {
    return configuration.entry == "vsm" || configuration.entry == "esm";
}

bool contains(const std::vector<Configuration>& list, const Configuration& configuration) {
    return std::find(list.begin(), list.end(), configuration) != list.end();
}

}  // namespace

std::string_view name(TruthKind kind) {
    switch (kind) {
        case TruthKind::area_light: return "area-light";
        case TruthKind::box_filter: return "box-filter";
        case TruthKind::disk_filter: break;
    }
    return "disk-filter";
}

std::string label(const Configuration& configuration) {
    if (configuration.entry == "none") return configuration.technique;
    std::string text =
        configuration.technique + " " + (configuration.side ? std::to_string(*configuration.side) : "auto");
    if (configuration.taps > 0) {
        const std::string taps = std::to_string(configuration.taps);
        text += ", " + (is_pcss(configuration) ? taps + "+" + taps : taps) + " taps";
    }
    if (configuration.no_skip.empty()) return text + ", nothing moved";
    if (configuration.no_skip == kDrawsUnchanged) return text;
    return text + ", with " + configuration.no_skip.substr(0, configuration.no_skip.find(','));
}

TruthKind truth_of(const Configuration& configuration) {
    if (is_prefiltered(configuration)) return TruthKind::box_filter;
    if (configuration.entry != "pcf") return TruthKind::area_light;
    const bool disk = configuration.filter == FilterMode::poisson || configuration.filter == FilterMode::rotated;
    return disk ? TruthKind::disk_filter : TruthKind::box_filter;
}

Configuration without_shadows() {
    return {"none", "none", FilterMode::automatic, 1, 0};
}

Configuration auto_hard() {
    return {"hard", "hard", FilterMode::automatic, std::nullopt, 0};
}

Configuration auto_pcf() {
    return {"pcf-exact", "pcf", FilterMode::exact, std::nullopt, 0};
}

Configuration fixed_pcf() {
    return {"pcf-rotated", "pcf", FilterMode::rotated, kBaselineSide, kBaselineTaps};
}

Configuration auto_pcss() {
    return {"pcss-levels", "pcss", FilterMode::exact, std::nullopt, 0};
}

Configuration fixed_pcss() {
    return {"pcss", "pcss", FilterMode::rotated, kBaselineSide, kBaselineTaps};
}

bool is_ablation(const Configuration& configuration) {
    return configuration.no_skip != kDrawsUnchanged;
}

std::vector<Configuration> ablations() {
    std::vector<Configuration> list;
    for (Configuration fixed : {fixed_pcf(), fixed_pcss()}) {
        fixed.no_skip = "all";
        list.push_back(fixed);
    }
    for (const Configuration& whole : {auto_pcf(), auto_pcss()}) {
        for (const SkipName& skip : kSkips) {
            const std::string drawn(skip.name);
            if (std::string_view(kDrawsUnchanged).find(drawn) != std::string_view::npos) continue;
            list.push_back(whole);
            list.back().no_skip = drawn + "," + kDrawsUnchanged;
        }
        list.push_back(whole);
        list.back().no_skip = "all";
        Configuration still = whole;
        still.no_skip = "";
        list.push_back(still);
    }
    return list;
}

Configuration baseline_of(const Configuration& configuration) {
    return is_pcss(configuration) ? fixed_pcss() : fixed_pcf();
}

std::vector<Configuration> ablation_configurations() {
    std::vector<Configuration> list{without_shadows(), auto_hard(), auto_pcf(), fixed_pcf(), auto_pcss(), fixed_pcss()};
    for (const Configuration& one : ablations()) list.push_back(one);
    return list;
}

std::vector<Configuration> all_configurations() {
    std::vector<Configuration> list{without_shadows()};
    const auto add = [&](const std::string& technique, const std::string& entry, FilterMode filter, int taps,
                         Warp warp = Warp::none) {
        for (const auto& side : kSides) list.push_back({technique, entry, filter, side, taps, warp});
    };
    add("hard", "hard", FilterMode::automatic, 0);
    add("pcf-exact", "pcf", FilterMode::exact, 0);
    for (const FilterMode filter : {FilterMode::jittered, FilterMode::poisson, FilterMode::rotated}) {
        for (const int taps : kTaps) add("pcf-" + std::string(name(filter)), "pcf", filter, taps);
    }
    for (const int taps : kTaps) add("pcss", "pcss", FilterMode::rotated, taps);
    add("pcss-levels", "pcss", FilterMode::exact, 0);
    for (const char* technique : {"vsm", "esm"}) add(technique, technique, FilterMode::automatic, 0);
    add("hard-lispsm", "hard", FilterMode::automatic, 0, Warp::lispsm);
    add("pcf-lispsm", "pcf", FilterMode::exact, 0, Warp::lispsm);
    for (const Configuration& one : ablations()) list.push_back(one);
    return list;
}

std::vector<Configuration> quick_configurations() {
    Configuration small_pcf = fixed_pcf();
    Configuration small_pcss = fixed_pcss();
    small_pcf.side = small_pcss.side = 1024;
    std::vector<Configuration> list{without_shadows(), auto_hard(), auto_pcf(),   fixed_pcf(),
                                    small_pcf,         auto_pcss(), fixed_pcss(), small_pcss};
    for (const Configuration& one : ablations()) {
        if (one.no_skip == "all" || one.no_skip.empty()) list.push_back(one);
    }
    return list;
}

double map_bytes(const Configuration& configuration, int largest_size) {
    const double side = configuration.side.value_or(largest_size);
    const double depths = 4 * side * side;
    // What is filtered lies in two textures, one with mipmaps; of a filter of 16 texels or more it is less.
    constexpr double kTextures = 2 + 1.0 / 3;
    if (configuration.entry == "vsm") return depths * (1 + 4 * kTextures);
    if (configuration.entry == "esm") return depths * (1 + 2 * kTextures);
    // Depths are floats; all of a map's levels together take less than its own size once more.
    return depths * (is_pcss(configuration) && configuration.filter == FilterMode::exact ? 2 : 1);
}

std::vector<std::vector<Configuration>> groups_of(const std::vector<Configuration>& list, double most_bytes,
                                                  int largest_size) {
    std::vector<std::vector<Configuration>> groups;
    double bytes = 0;
    for (const Configuration& configuration : list) {
        // A baseline is in the groups that need it; by itself it makes one.
        std::vector<Configuration> wanted{baseline_of(configuration)};
        if (configuration != wanted.front()) wanted.push_back(configuration);
        const auto missing_bytes = [&] {
            double sum = 0;
            for (const Configuration& one : wanted) {
                if (groups.empty() || !contains(groups.back(), one)) sum += map_bytes(one, largest_size);
            }
            return sum;
        };
        if (groups.empty() || bytes + missing_bytes() > most_bytes) {
            groups.emplace_back();
            bytes = 0;
        }
        bytes += missing_bytes();
        for (const Configuration& one : wanted) {
            if (contains(groups.back(), one)) continue;
            if (one == baseline_of(one)) {
                groups.back().insert(groups.back().begin(), one);
            } else {
                groups.back().push_back(one);
            }
        }
    }
    return groups;
}

}  // namespace stairstep::bench
