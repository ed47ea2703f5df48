// A city of over a million triangles: blocks of houses and towers with windows, roofs, trees, an airship above.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// Blocks a side, lots a block's side.
constexpr int kBlocks = 8;
constexpr int kLots = 3;
constexpr double kLot = 13;
constexpr double kStreet = 21;
constexpr double kPavement = 0.15;
constexpr double kPitch = kLots * kLot + kStreet;
constexpr double kFloorHeight = 3.2;

constexpr std::array<glm::vec3, 5> kWalls{{{0.62f, 0.52f, 0.40f},
                                           {0.50f, 0.25f, 0.17f},
                                           {0.66f, 0.63f, 0.57f},
                                           {0.42f, 0.41f, 0.40f},
                                           {0.58f, 0.40f, 0.26f}}};

/// What the city is made of, a mesh a colour.
struct Parts {
    std::array<Mesh, kWalls.size()> walls;
    Mesh glass;
    Mesh roofs;
    Mesh metal;
    Mesh pavement;
    Mesh trunks;
    Mesh crowns;
};

/// A building's body, on a rectangle around (x, z).
struct Body {
    glm::dvec2 middle;
    glm::dvec2 half;
    double low = 0;
    int floors = 1;

    double high() const { return low + floors * kFloorHeight; }
    /// A box given by ranges along x, y and z relative to the middle and to height 0.
    void append(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to) const {
        const glm::dvec3 offset(middle.x, 0, middle.y);
        append_box(mesh, from + offset, to + offset);
    }
};

/// Windows with sills on all four sides, and on some buildings balconies.
void append_windows(Parts& parts, Mesh& wall, const Body& body, bool balconies) {
    for (int axis = 0; axis < 2; ++axis) {
        const double along = body.half[1 - axis];
        const double out = body.half[axis];
        const int count = std::max(2, static_cast<int>(2 * along / 2.4));
        const double step = 2 * along / count;
        for (int i = 0; i < count * body.floors * 2; ++i) {
            const double side = i % 2 ? 1 : -1;
            const double at = -along + (i / 2 % count + 0.5) * step;
            const double y = body.low + (i / 2 / count) * kFloorHeight;
            const auto panel = [&](Mesh& mesh, double half_width, double low, double high, double depth) {
                const double near = std::min(side * (out - 0.02), side * (out + depth));
                const double far = std::max(side * (out - 0.02), side * (out + depth));
                if (axis == 0) {
                    body.append(mesh, {near, y + low, at - half_width}, {far, y + high, at + half_width});
                } else {
                    body.append(mesh, {at - half_width, y + low, near}, {at + half_width, y + high, far});
                }
            };
            panel(parts.glass, 0.3 * step, 0.9, 2.5, 0.06);
            if (balconies && (i / 2) % 2 == 0) {
                panel(wall, 0.42 * step, 0.0, 0.9, 1.1);
            } else {
                panel(wall, 0.36 * step, 0.75, 0.9, 0.22);
            }
        }
    }
}

/// A parapet with machines behind it.
void append_flat_roof(Parts& parts, Mesh& wall, const Body& body, Random& random) {
    const double y = body.high();
    const glm::dvec2 h = body.half + 0.15;
    body.append(wall, {-h.x, y, -h.y}, {h.x, y + 0.9, -h.y + 0.35});
    body.append(wall, {-h.x, y, h.y - 0.35}, {h.x, y + 0.9, h.y});
    body.append(wall, {-h.x, y, -h.y + 0.35}, {-h.x + 0.35, y + 0.9, h.y - 0.35});
    body.append(wall, {h.x - 0.35, y, -h.y + 0.35}, {h.x, y + 0.9, h.y - 0.35});
    for (int i = 0; i < 3; ++i) {
        const double x = (random.uniform() - 0.5) * (body.half.x - 0.5);
        const double z = (random.uniform() - 0.5) * (body.half.y - 0.5);
        const double size = 0.5 + random.uniform();
        body.append(parts.metal, {x - size, y, z - size}, {x + size, y + 0.8 + size, z + size});
    }
    const glm::dvec3 mast(body.middle.x + 0.6 * body.half.x, y, body.middle.y + 0.6 * body.half.y);
    if (random.uniform() < 0.4) {
        append_cylinder(parts.metal, mast, mast + glm::dvec3(0, 3 + 5 * random.uniform(), 0), 0.12, 0.04, 8);
    }
    if (random.uniform() < 0.35) {
        const glm::dvec2 tank[] = {{1.1, 1.6}, {1.1, 3.6}, {0, 4.6}};
        const glm::dvec3 foot(body.middle.x - 0.5 * body.half.x, y, body.middle.y - 0.5 * body.half.y);
        append_turned(parts.trunks, foot, tank, 16);
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 leg(i % 2 ? 0.7 : -0.7, 0, i < 2 ? 0.7 : -0.7);
            append_beam(parts.metal, foot + leg, foot + leg + glm::dvec3(0, 1.65, 0), 0.14);
        }
    }
}

/// A gable along z with a chimney.
void append_gable_roof(Parts& parts, const Body& body) {
    const double half = body.half.x + 0.5;
    const double rise = 0.75 * half;
    // Around its own middle, as a sweep's outline must be.
    const std::vector<glm::dvec2> gable{{-half, -rise / 3}, {half, -rise / 3}, {0, 2 * rise / 3}};
    const Section sections[] = {{-body.half.y - 0.4, 1}, {body.half.y + 0.4, 1}};
    glm::dmat4 place(1);
    place[3] = glm::dvec4(body.middle.x, body.high() + rise / 3, body.middle.y, 1);
    append_sweep(parts.roofs, gable, sections, place);
    body.append(parts.roofs, {0.4 * half, body.high(), -0.4}, {0.4 * half + 0.8, body.high() + rise + 0.6, 0.4});
}

/// One lot: a house, or a tower in steps where the city is high.
void append_building(Parts& parts, const glm::dvec2& middle, double height_factor, Random& random) {
    Mesh& wall = parts.walls[random.below(parts.walls.size())];
    Body body{middle, {kLot / 2 - 0.6 - 1.2 * random.uniform(), kLot / 2 - 0.6 - 1.2 * random.uniform()}, kPavement, 1};
    const bool tower = random.uniform() < 0.25 * height_factor;
    const bool balconies = !tower && random.uniform() < 0.3;
    body.floors = 3 + static_cast<int>(random.below(4)) + static_cast<int>(height_factor * 7 * random.uniform());
    for (int step = 0; step < (tower ? 3 : 1); ++step) {
        if (step > 0) {
            body.low = body.high();
            body.half *= 0.8;
            body.floors = 3 + static_cast<int>(random.below(4));
        }
        body.append(wall, {-body.half.x, body.low, -body.half.y}, {body.half.x, body.high(), body.half.y});
        body.append(wall, {-body.half.x - 0.25, body.high() - 0.3, -body.half.y - 0.25},
                    {body.half.x + 0.25, body.high(), body.half.y + 0.25});
        append_windows(parts, wall, body, balconies);
    }
    if (!tower && body.floors < 6 && random.uniform() < 0.6) {
        append_gable_roof(parts, body);
    } else {
        append_flat_roof(parts, wall, body, random);
    }
}

void append_tree(Parts& parts, const glm::dvec3& foot, Random& random) {
    const double size = 0.8 + 0.5 * random.uniform();
    append_cylinder(parts.trunks, foot, foot + size * glm::dvec3(0, 2.4, 0), 0.18 * size, 0.14 * size, 8);
    const glm::dvec2 crown[] = {{0, 2.0}, {1.2, 2.4}, {1.8, 3.4}, {1.5, 4.6}, {0.8, 5.4}, {0, 5.7}};
    std::vector<glm::dvec2> sized;
    for (const glm::dvec2& point : crown) sized.push_back(size * point);
    append_turned(parts.crowns, foot, sized, 12);
}

/// A block's pavement and lots; some are parks.
void append_block(Parts& parts, const glm::dvec2& middle, Random random) {
    const double half = kLots * kLot / 2;
    append_box(parts.pavement, {middle.x - half - 2, -0.5, middle.y - half - 2},
               {middle.x + half + 2, kPavement, middle.y + half + 2});
    // Towers stand in the middle of the city.
    const double from_centre = glm::length(middle) / (kBlocks * kPitch / 2);
    const double height_factor = std::clamp(1.15 - from_centre, 0.0, 1.0);
    for (int i = 0; i < kLots * kLots; ++i) {
        const glm::dvec2 lot = middle + kLot * (glm::dvec2(i % kLots, i / kLots) - (kLots - 1) / 2.0);
        if (random.uniform() < 0.9) {
            append_building(parts, lot, height_factor, random);
        } else {
            for (int tree = 0; tree < 9; ++tree) {
                const glm::dvec2 at = lot + 3.8 * (glm::dvec2(tree % 3, tree / 3) - 1.0);
                append_tree(parts, {at.x, kPavement, at.y}, random);
            }
        }
    }
    for (int i = 0; i < 12; ++i) {
        const double along = -half + (i % 6 + 0.5) * (2 * half / 6);
        append_tree(parts, {middle.x + along, kPavement, middle.y + (i < 6 ? -1 : 1) * (half + 0.9)}, random);
    }
}

/// Modelled around the origin, its nose along +x.
void append_airship(Mesh& hull, Mesh& fins) {
    std::vector<Section> sections;
    for (int i = 0; i <= 24; ++i) {
        const double along = -1 + 2 * i / 24.0;
        const double radius = i % 24 ? std::sqrt(1 - along * along) * (1 + 0.15 * along) : 0;
        sections.push_back({26 * along, 6 * radius});
    }
    append_sweep(hull, regular_outline(1, 32), sections, frame_along(glm::dvec3(0), {1, 0, 0}));
    append_box(fins, {-2, -8.2, -1.3}, {7, -5.6, 1.3});
    append_box(fins, {-25, -8, -0.2}, {-17, 8, 0.2});
    append_box(fins, {-25, -0.2, -8}, {-17, 0.2, 8});
}

std::vector<glm::dmat4> movers_at(double t) {
    glm::dmat4 flight = turn_about(glm::dvec3(0), 30 - 60 * t);
    flight[3] = glm::dvec4(-50 + 100 * t, 74, 50 - 60 * std::sin(std::numbers::pi * t), 1);
    return {flight};
}

AnimatedScene make_city() {
    Parts parts;
    const Random random(1);
    for (int i = 0; i < kBlocks * kBlocks; ++i) {
        const glm::dvec2 middle = kPitch * (glm::dvec2(i % kBlocks, i / kBlocks) - (kBlocks - 1) / 2.0);
        append_block(parts, middle, random.stream(i));
    }
    Mesh hull;
    Mesh fins;
    append_airship(hull, fins);

    AnimatedScene animated;
    animated.name = "city";
    Scene& scene = animated.scene;
    for (size_t i = 0; i < kWalls.size(); ++i) add_part(scene, kWalls[i], std::move(parts.walls[i]));
    add_part(scene, {0.10f, 0.13f, 0.17f}, std::move(parts.glass));
    add_part(scene, {0.36f, 0.15f, 0.10f}, std::move(parts.roofs));
    add_part(scene, {0.48f, 0.49f, 0.50f}, std::move(parts.metal));
    add_part(scene, {0.45f, 0.44f, 0.42f}, std::move(parts.pavement));
    add_part(scene, {0.22f, 0.14f, 0.09f}, std::move(parts.trunks));
    add_part(scene, {0.13f, 0.25f, 0.07f}, std::move(parts.crowns));
    add_part(scene, {0.76f, 0.74f, 0.70f}, std::move(hull), 0);
    add_part(scene, {0.55f, 0.12f, 0.08f}, std::move(fins), 0);
    add_floor(scene, 0, 4000, {0.33f, 0.33f, 0.34f});

    Walk walk;
    walk.target = {10, 12, 20};
    walk.eye = {-75, 130, 190};
    walk.turn_deg = 40;
    walk.approach = 0.7;
    walk.vertical_fov_deg = 40;
    walk.near = 10;
    walk.far = 3000;
    animated.state = staged({walking_camera(walk), orbiting_light({-62, 46}, 80, 8, 0.025), movers_at});
    animated.radius = 2;
    return animated;
}

}  // namespace

SceneEntry city_scene() {
    return {"city", "over a million triangles: streets of detailed buildings under an airship", make_city};
}

}  // namespace stairstep
