#include "renderer/stress/measurement.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "renderer/shadow_renderer.h"
#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep::stress {
namespace {

/// A filter may look beyond its radius by a texel, and shadows are moved by half a one as they are sampled.
constexpr double kMarginTexels = 2.5;
/// Prefiltered maps are averaged over pixels besides.
constexpr double kMarginPixels = 2;
/// Of the picture of a contact, px a side.
constexpr int kContactPixels = 64;
/// Courses draw small pictures, so that what changes between frames is most of the work.
constexpr int kCourseWidth = 48;
constexpr int kCourseHeight = 27;
constexpr int kMostSide = 512;
constexpr uint64_t kSizesSeed = 1;
/// Steps of a course after which all memory should have been reserved.
constexpr int kSettlingSteps = 2 * kPeriod;

bool is_visibility(float value) {
    return value >= 0 && value <= 1;
}

size_t strange_pixels(const std::vector<float>& values) {
    return static_cast<size_t>(std::ranges::count_if(values, [](float value) { return !is_visibility(value); }));
}

/// A condition's radius as ShadowSettings', which is one at the middle of all casters: of a spot, casters that the truth doesn't know
/// of move that.
double radius_at_casters(const Condition& condition, const Scene& scene) {
    if (condition.stage.light.kind == Light::Kind::directional || condition.extra.empty()) return condition.radius;
    return light_plane_radius(condition) *
           std::max(depth_along(condition.stage.light, caster_bounds(scene).centre()), 1e-9);
}

/// A condition's scene and what draws it, for a picture of one size.
class Drawing {
  public:
    Drawing(const Condition& condition, const TechniqueEntry& entry, const MeasurementSettings& settings)
        : condition_(condition),
          scene_(upload(all_meshes(condition))),
          target_(make_frame_target(Show::visibility, settings.width, settings.height, 1)),
          renderer_(entry, settings_of(condition, settings), scene_, state_of(condition.stage, condition.placement),
                    static_cast<double>(settings.width) / settings.height) {}

    std::vector<float> draw(const Stage& stage) {
        renderer_.draw(scene_, state_of(stage, condition_.placement), target_, timer_);
        return read_visibility(target_);
    }

    std::vector<float> draw_with(const ShadowMapShape& shape, const Stage& stage, const FrameTarget& target) {
        renderer_.draw_with(shape, scene_, state_of(stage, condition_.placement), target, timer_);
        return read_visibility(target);
    }

    ShadowTechnique::Lookups lookups() const { return renderer_.technique().lookups(renderer_.map()); }
    const ShadowMapShape& shape() const { return renderer_.map().shape; }
    const FrameTarget& target() const { return target_; }

  private:
    static Scene all_meshes(const Condition& condition) {
        Scene scene = scene_of(condition.stage, condition.placement.scale);
        scene.meshes.insert(scene.meshes.end(), condition.extra.begin(), condition.extra.end());
        return scene;
    }

    static ShadowSettings settings_of(const Condition& condition, const MeasurementSettings& settings) {
        ShadowSettings shadow;
        shadow.radius = radius_at_casters(condition, all_meshes(condition)) * condition.placement.scale;
        shadow.fixed_size = condition.fixed_size;
        shadow.depth = condition.depth;
        shadow.largest_size = settings.largest_size;
        return shadow;
    }

    const Condition& condition_;
    GpuScene scene_;
    FrameTarget target_;
    gl::PassTimer timer_;
    ShadowRenderer renderer_;
};

/// Longer side of a texel, light plane, at home.
double texel_at_home(const Condition& condition, const ShadowMapShape& shape) {
    const double texel = std::max(shape.texel().x, shape.texel().y);
    return shape.frustum.kind == Light::Kind::spot ? texel : texel / condition.placement.scale;
}

/// What a pixel covers of the light plane in the middle of the stage, at home.
double pixel_at_home(const Condition& condition, int height) {
    const Stage& stage = condition.stage;
    const double pixel = pixel_footprint(stage.camera, glm::length(stage.camera.eye), height);
    return stage.light.kind == Light::Kind::spot ? pixel / depth_along(stage.light, glm::dvec3(0)) : pixel;
}

/// A contact seen from near by: the stage with another camera, and the strip along it.
struct Contact {
    Stage stage;
    glm::dvec3 middle;
    glm::dvec3 outwards;
    /// Home.
    double width = 0;
    double texel = 0;
};

std::optional<Contact> contact_of(const Condition& condition, const ShadowMapShape& shape) {
    if (condition.stage.boxes.empty() || condition.stage.ground_half_side <= 0) return std::nullopt;
    const Bounds& box = condition.stage.boxes.front();
    const Light& light = condition.stage.light;
    const glm::dvec3 foot(box.centre().x, box.low.y, box.centre().z);
    const glm::dvec3 to_light =
        light.kind == Light::Kind::spot ? glm::normalize(light.position - foot) : light.basis.back;
    Contact contact{condition.stage, {}, {}, 0, texel_at_home(condition, shape)};
    const bool along_x = std::abs(to_light.x) > std::abs(to_light.z);
    contact.outwards[along_x ? 0 : 2] = (along_x ? to_light.x : to_light.z) > 0 ? -1 : 1;
    contact.middle = foot + 0.5 * contact.outwards * (box.high - box.low);
    if (light.kind == Light::Kind::spot) contact.texel *= depth_along(light, contact.middle);
    contact.width = std::min(kContactTexels * contact.texel, 0.25);
    const glm::dvec3 target = contact.middle + 0.5 * contact.width * contact.outwards;
    const double field = 2 * std::atan(0.5 * contact.width) * 180 / std::numbers::pi;
    contact.stage.camera =
        camera_looking_at(target + glm::normalize(contact.outwards + glm::dvec3(0, 1, 0)), target, field, 0.1, 10);
    return contact;
}

std::optional<double> detachment(Drawing& drawing, const Condition& condition, size_t& strange) {
    const ShadowMapShape shape = drawing.shape();
    const std::optional<Contact> contact = contact_of(condition, shape);
    if (!contact) return std::nullopt;
    const FrameTarget target = make_frame_target(Show::visibility, kContactPixels, kContactPixels, 1);
    const std::vector<float> values = drawing.draw_with(shape, contact->stage, target);
    strange += strange_pixels(values);
    double light = 0;
    int dark = 0;
    for (int row = 0; row < kContactPixels; ++row) {
        for (int column = 0; column < kContactPixels; ++column) {
            const auto seen = seen_at(contact->stage, column, row, kContactPixels, kContactPixels);
            if (!seen || seen->face != -1) continue;
            const double distance = glm::dot(seen->position - contact->middle, contact->outwards);
            if (!(distance > 0 && distance < contact->width)) continue;
            if (!is_hidden(contact->stage, seen->position, 0, 0)) return std::nullopt;
            const float value = values[static_cast<size_t>(row) * kContactPixels + column];
            light += is_visibility(value) ? value : 1;
            ++dark;
        }
    }
    if (dark == 0) return std::nullopt;
    return light / dark * contact->width / contact->texel;
}

void compare(Measurement& one, const std::vector<float>& values, const std::vector<float>& truth) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        // Where light comes edge-on there is nothing to compare.
        if (std::isnan(truth[i])) continue;
        ++count;
        const double error = is_visibility(values[i]) ? std::abs(values[i] - truth[i]) : 1;
        sum += error * error;
        one.error_max = std::max(one.error_max, error);
    }
    one.error_rmse = count ? std::sqrt(sum / static_cast<double>(count)) : 0;
    one.nan_pixels += strange_pixels(values);
}

std::optional<double> acne(const std::vector<float>& values, const std::vector<bool>& clear) {
    size_t count = 0;
    size_t dark = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        count += clear[i] ? 1 : 0;
        // Written so that NaN is dark.
        dark += clear[i] && !(values[i] >= kLeastLight) ? 1 : 0;
    }
    if (count == 0) return std::nullopt;
    return static_cast<double>(dark) / static_cast<double>(count);
}

void measure_picture(Measurement& one, const Condition& condition, const TechniqueEntry& entry,
                     const MeasurementSettings& settings, const std::vector<float>& visibility) {
    Drawing drawing(condition, entry, settings);
    const std::vector<float> values = drawing.draw(condition.stage);
    one.map_width = drawing.shape().width;
    one.map_height = drawing.shape().height;
    compare(one, values, visibility);
    double margin = kMarginTexels * texel_at_home(condition, drawing.shape());
    if (drawing.lookups().prefiltered) margin += kMarginPixels * pixel_at_home(condition, settings.height);
    one.acne_share = acne(values, clear_pixels(condition.stage, truth_for(one.technique), light_plane_radius(condition),
                                               margin, visibility, settings.width, settings.height));
    one.detachment_texels = detachment(drawing, condition, one.nan_pixels);
}

double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double largest = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        // Written so that NaN is a difference.
        const double one = std::abs(a[i] - b[i]);
        if (!(one <= largest)) largest = one;
    }
    return largest;
}

/// Draws a course of whole periods; each begins with the state of the first one after the settling.
void measure_course(Measurement& one, const Condition& condition, const TechniqueEntry& entry,
                    const MeasurementSettings& settings) {
    MeasurementSettings small = settings;
    small.width = kCourseWidth;
    small.height = kCourseHeight;
    Drawing drawing(condition, entry, small);
    drawing.draw(condition.stage);
    const LightFrustum frustum = drawing.shape().frustum;
    Random random(kSizesSeed);
    std::vector<float> reference;
    std::optional<double> before;
    std::optional<double> halfway;
    const auto draw = [&](int step) {
        if (condition.course == Course::frames) return drawing.draw(swung(condition.stage, step));
        // Each period begins with the same size; the largest comes first, so that memory is reserved early.
        const int side = step % kPeriod == 0 ? kMostSide : 1 + static_cast<int>(random.below(kMostSide));
        return drawing.draw_with(map_of_size(frustum, side), condition.stage, drawing.target());
    };
    const int last = condition.steps / kPeriod * kPeriod;
    for (int step = 0; step <= last; ++step) {
        std::vector<float> values = draw(step);
        one.nan_pixels += strange_pixels(values);
        if (step % kPeriod != 0 || step < kSettlingSteps) continue;
        // Frames that are compared are all drawn in the same way, to the last bit: one that repeats the last is stored.
        values = draw(step);
        if (step == kSettlingSteps) {
            reference = values;
            before = resident_kib();
        } else {
            one.drift = std::max(one.drift.value_or(0), difference(values, reference));
        }
        if (step <= kSettlingSteps + (last - kSettlingSteps) / 2) halfway = resident_kib();
    }
    const std::optional<double> after = resident_kib();
    if (one.drift && before && after) one.growth_kib = *after - *before;
    if (one.drift && halfway && after) one.late_growth_kib = *after - *halfway;
    one.map_width = drawing.shape().width;
    one.map_height = drawing.shape().height;
}

}  // namespace

TruthOf truth_for(const std::string& technique) {
    if (technique == "pcss") return TruthOf::area;
    if (technique == "pcf" || technique == "vsm" || technique == "esm") return TruthOf::filter;
    return TruthOf::point;
}

double light_plane_radius(const Condition& condition) {
    const Light& light = condition.stage.light;
    if (light.kind == Light::Kind::directional) return condition.radius;
    const Bounds casters = caster_bounds(scene_of(condition.stage, 1));
    return condition.radius / depth_along(light, casters.empty() ? glm::dvec3(0) : casters.centre());
}

std::optional<double> resident_kib() {
    std::ifstream statm("/proc/self/statm");
    double total_pages = 0;
    double resident_pages = 0;
    if (!(statm >> total_pages >> resident_pages)) return std::nullopt;
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024;
}

Measurement measure(const Condition& condition, const TechniqueEntry& entry, const MeasurementSettings& settings,
                    const std::vector<float>& visibility) {
    Measurement one;
    one.technique = entry.name;
    try {
        if (condition.course == Course::picture) {
            measure_picture(one, condition, entry, settings, visibility);
        } else {
            measure_course(one, condition, entry, settings);
        }
    } catch (const InputError& error) {
        one.refusal = error.what();
    } catch (const FailureError& error) {
        one.failure = error.what();
        ++one.gl_errors;
    }
    return one;
}

}  // namespace stairstep::stress
