#include "renderer/stress/stage_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "stimuli/parallel.h"

namespace stairstep::stress {
namespace {

constexpr int kMidpoints = 20;
/// Points over which margins are looked for shadow lie no further apart than this, light plane: less than what the stage's
/// thinnest part covers of it.
constexpr double kMarginStep = 0.03;
constexpr int kMostMarginPoints = 61;
/// Where the light has a size, which is looked over besides.
constexpr int kMostMarginPointsOfArea = 15;
/// Cosine below which light meets a facet edge-on.
constexpr double kEdgeOn = 1e-6;

/// The point of the receiver's plane that lies (x, y) from it in the light plane; nullopt where the plane has none, seen from a
/// spot.
std::optional<glm::dvec3> moved_across(const Light& light, const SeenPoint& point, double x, double y) {
    const auto& [right, up, back] = light.basis;
    if (light.kind == Light::Kind::directional) {
        const glm::dvec3 across = x * right + y * up;
        return point.position + across - glm::dot(point.normal, across) / glm::dot(point.normal, back) * back;
    }
    const glm::dvec3 from_light = point.position - light.position;
    const double depth = -glm::dot(back, from_light);
    const glm::dvec3 direction =
        (glm::dot(right, from_light) / depth + x) * right + (glm::dot(up, from_light) / depth + y) * up - back;
    const double along = glm::dot(point.normal, from_light) / glm::dot(point.normal, direction);
    // Written so that NaN fails.
    if (!(along > 0 && std::isfinite(along))) return std::nullopt;
    return light.position + along * direction;
}

bool is_lit(const Stage& stage, const SeenPoint& point, double x, double y, double u, double v) {
    const auto moved = moved_across(stage.light, point, x, y);
    return !moved || !is_hidden(stage, *moved, u, v);
}

/// Mean over midpoints of [−1, 1]².
template <typename Lit>
double mean_over_square(Lit lit) {
    int count = 0;
    for (int j = 0; j < kMidpoints; ++j) {
        for (int i = 0; i < kMidpoints; ++i) {
            count += lit((2 * i + 1.0) / kMidpoints - 1, (2 * j + 1.0) / kMidpoints - 1) ? 1 : 0;
        }
    }
    return static_cast<double>(count) / (kMidpoints * kMidpoints);
}

bool is_edge_on(const Light& light, const SeenPoint& point) {
    const glm::dvec3 to_light =
        light.kind == Light::Kind::directional ? light.basis.back : glm::normalize(light.position - point.position);
    return std::abs(glm::dot(point.normal, to_light)) < kEdgeOn;
}

double visibility_of(const Stage& stage, TruthOf kind, double radius, const SeenPoint& point) {
    if (is_edge_on(stage.light, point)) return std::numeric_limits<double>::quiet_NaN();
    if (!faces_light(stage.light, point)) return 0;
    if (kind == TruthOf::filter && radius > 0) {
        return mean_over_square([&](double x, double y) { return is_lit(stage, point, radius * x, radius * y, 0, 0); });
    }
    if (kind == TruthOf::area && stage.light.half_side > 0) {
        return mean_over_square([&](double u, double v) { return !is_hidden(stage, point.position, u, v); });
    }
    return is_hidden(stage, point.position, 0, 0) ? 0 : 1;
}

/// Evenly from −reach to reach.
std::vector<double> points_over(double reach, int most) {
    const int count = std::clamp(static_cast<int>(std::min(2 * reach / kMarginStep, 1e6)) + 2, 3, most);
    std::vector<double> points;
    for (int i = 0; i < count; ++i) points.push_back(reach * (2.0 * i / (count - 1) - 1));
    return points;
}

/// Whether all within the margin of what a filter looks at is lit.
bool is_clear_at(const Stage& stage, TruthOf kind, double radius, double margin, const SeenPoint& point) {
    const std::vector<double> places =
        kind == TruthOf::area ? points_over(margin, kMostMarginPointsOfArea)
                              : points_over(margin + (kind == TruthOf::filter ? radius : 0), kMostMarginPoints);
    const std::vector<double> lights =
        kind == TruthOf::area ? std::vector<double>{-1, -0.5, 0, 0.5, 1} : std::vector<double>{0};
    for (const double x : places) {
        for (const double y : places) {
            const std::optional<glm::dvec3> moved = moved_across(stage.light, point, x, y);
            if (!moved) continue;
            for (const double u : lights) {
                for (const double v : lights) {
                    if (is_hidden(stage, *moved, u, v)) return false;
                }
            }
        }
    }
    return true;
}

using Seen = std::vector<std::optional<SeenPoint>>;

Seen all_seen(const Stage& stage, int width, int height) {
    Seen seen(static_cast<size_t>(width) * height);
    run_in_parallel(height, 0, [&](size_t row) {
        for (int column = 0; column < width; ++column) {
            seen[row * width + column] = seen_at(stage, column, static_cast<int>(row), width, height);
        }
    });
    return seen;
}

bool is_inside_a_face(const Seen& seen, int column, int row, int width, int height) {
    const int face = seen[static_cast<size_t>(row) * width + column]->face;
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, height - 1); ++j) {
        for (int i = std::max(column - 1, 0); i <= std::min(column + 1, width - 1); ++i) {
            const std::optional<SeenPoint>& there = seen[static_cast<size_t>(j) * width + i];
            if (!there || there->face != face) return false;
        }
    }
    return true;
}

}  // namespace

std::vector<float> true_visibility(const Stage& stage, TruthOf kind, double radius, int width, int height) {
    const Seen seen = all_seen(stage, width, height);
    std::vector<float> visibility(seen.size(), 1);
    run_in_parallel(height, 0, [&](size_t row) {
        for (size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
            if (seen[pixel]) visibility[pixel] = static_cast<float>(visibility_of(stage, kind, radius, *seen[pixel]));
        }
    });
    return visibility;
}

std::vector<bool> clear_pixels(const Stage& stage, TruthOf kind, double radius, double margin,
                               const std::vector<float>& visibility, int width, int height) {
    const Seen seen = all_seen(stage, width, height);
    // Bits of a vector<bool> share bytes, which threads must not.
    std::vector<char> clear(seen.size(), 0);
    run_in_parallel(height, 0, [&](size_t row) {
        for (int column = 0; column < width; ++column) {
            const size_t pixel = row * width + column;
            clear[pixel] = seen[pixel] && visibility[pixel] == 1 &&
                           is_inside_a_face(seen, column, static_cast<int>(row), width, height) &&
                           is_clear_at(stage, kind, radius, margin, *seen[pixel]);
        }
    });
    return {clear.begin(), clear.end()};
}

}  // namespace stairstep::stress
