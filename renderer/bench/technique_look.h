// How techniques look in figures, the same in all.
#pragma once

#include <array>

namespace stairstep::bench {

/// A colour that differs for every kind of colour vision (Okabe & Ito 2008); gnuplot's open marker, its filled one is the next.
struct TechniqueLook {
    /// As Configuration::technique.
    const char* technique;
    const char* colour;
    int marker;
};

inline constexpr std::array kTechniqueLooks{
    TechniqueLook{"none", "#777777", 10},        TechniqueLook{"hard", "#000000", 8},
    TechniqueLook{"pcss", "#e69f00", 12},        TechniqueLook{"pcss-levels", "#009e73", 12},
    TechniqueLook{"pcf-exact", "#0072b2", 4},    TechniqueLook{"pcf-jittered", "#009e73", 6},
    TechniqueLook{"pcf-poisson", "#e69f00", 12}, TechniqueLook{"pcf-rotated", "#d55e00", 6},
    TechniqueLook{"vsm", "#cc79a7", 8},          TechniqueLook{"esm", "#56b4e9", 10},
};

}  // namespace stairstep::bench
