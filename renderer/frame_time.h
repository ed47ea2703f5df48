// What a frame took, pass by pass.
#pragma once

#include "renderer/gl/pass_timer.h"

namespace stairstep {

struct FrameTime {
    /// The shadow maps.
    gl::PassTime depth;
    /// What the technique makes of them ahead of the lighting.
    gl::PassTime prepare;
    /// What the camera sees nearest, where that is stored before it is lit; else it is drawn as part of the lighting.
    gl::PassTime surfaces;
    /// What lights shade of it.
    gl::PassTime query;
    gl::PassTime lighting;
    /// What the next frame needs.
    gl::PassTime need;
    /// Fits of frusta, choices of sizes and culling, on the CPU, ms.
    double fit_ms = 0;
    /// Whether surfaces were stored before they were lit (surface_choice.h).
    bool stored = false;

    double cpu_ms() const {
        return depth.cpu_ms + prepare.cpu_ms + surfaces.cpu_ms + query.cpu_ms + lighting.cpu_ms + need.cpu_ms + fit_ms;
    }
    double gpu_ms() const {
        return depth.gpu_ms + prepare.gpu_ms + surfaces.gpu_ms + query.gpu_ms + lighting.gpu_ms + need.gpu_ms;
    }
};

}  // namespace stairstep
