#include "renderer/comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stimuli/stimulus.h"

namespace stairstep {

PictureDifference compare_pictures(const Image& a, const Image& b) {
    assert(a.pixels.size() == b.pixels.size() && a.channels == b.channels && !a.pixels.empty());
    PictureDifference difference;
    double squares = 0;
    size_t over_1 = 0;
    size_t over_8 = 0;
    for (size_t pixel = 0; pixel < a.pixels.size(); pixel += a.channels) {
        int worst = 0;
        for (int channel = 0; channel < a.channels; ++channel) {
            const int apart = std::abs(a.pixels[pixel + channel] - b.pixels[pixel + channel]);
            squares += apart * apart;
            worst = std::max(worst, apart);
        }
        difference.max_levels = std::max(difference.max_levels, worst);
        over_1 += worst > 1;
        over_8 += worst > 8;
    }
    const double pixels = static_cast<double>(a.pixels.size()) / a.channels;
    difference.rmse_levels = std::sqrt(squares / static_cast<double>(a.pixels.size()));
    difference.share_over_1_level = static_cast<double>(over_1) / pixels;
    difference.share_over_8_levels = static_cast<double>(over_8) / pixels;
    return difference;
}

Image difference_picture(const Image& a, const Image& b, int scale) {
    Image picture(a.width, a.height, a.channels);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        picture.pixels[i] = static_cast<uint8_t>(std::min(255, std::abs(a.pixels[i] - b.pixels[i]) * scale));
    }
    return picture;
}

int difference_scale(const PictureDifference& difference) {
    return std::clamp(255 / std::max(1, difference.max_levels), 1, 32);
}

VisibilityError compare_visibility(const std::vector<float>& rendered, const std::vector<float>& truth) {
    assert(rendered.size() == truth.size() && !truth.empty());
    VisibilityError error;
    double squares = 0;
    double penumbra_squares = 0;
    size_t penumbra = 0;
    double bled = 0;
    size_t dark = 0;
    size_t over_1 = 0;
    size_t over_8 = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
        const double apart = std::abs(static_cast<double>(rendered[i]) - truth[i]);
        squares += apart * apart;
        if (truth[i] > 0 && truth[i] < 1) {
            penumbra_squares += apart * apart;
            ++penumbra;
        }
        if (truth[i] == 0) {
            bled += rendered[i];
            ++dark;
        }
        error.max = std::max(error.max, apart);
        over_1 += apart > 1 / 255.0;
        over_8 += apart > 8 / 255.0;
    }
    const auto pixels = static_cast<double>(truth.size());
    error.rmse = std::sqrt(squares / pixels);
    error.penumbra_rmse = penumbra ? std::sqrt(penumbra_squares / static_cast<double>(penumbra)) : 0;
    error.share_over_1_level = static_cast<double>(over_1) / pixels;
    error.share_over_8_levels = static_cast<double>(over_8) / pixels;
    error.penumbra_share = static_cast<double>(penumbra) / pixels;
    error.light_bleeding = dark ? bled / static_cast<double>(dark) : 0;
    return error;
}

void Wobble::add(const std::vector<float>& rendered, const std::vector<float>& truth) {
    assert(rendered.size() == truth.size() && !truth.empty());
    assert(frames_ == 0 || error_.size() == truth.size());
    error_.resize(truth.size());
    for (size_t i = 0; i < truth.size(); ++i) {
        const double error = static_cast<double>(rendered[i]) - truth[i];
        if (frames_ > 0) sum_ += std::abs(error - error_[i]);
        error_[i] = error;
    }
    ++frames_;
}

double Wobble::mean() const {
    return frames_ < 2 ? 0 : sum_ / (static_cast<double>(frames_ - 1) * static_cast<double>(error_.size()));
}

Image visibility_picture(const std::vector<float>& visibility, int width, int height) {
    Image picture(width, height, 1);
    std::transform(visibility.begin(), visibility.end(), picture.pixels.begin(),
                   [](float value) { return static_cast<uint8_t>(level_8bit(value)); });
    return picture;
}

}  // namespace stairstep
