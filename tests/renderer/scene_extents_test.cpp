#include "renderer/scene_extents.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

double side_of(const glm::dvec4& plane, const glm::dvec3& point) {
    return (glm::dot(glm::dvec3(plane), point) + plane.w) / glm::length(glm::dvec3(plane));
}

std::vector<glm::dvec4> planes_of(const Bounds& box, const glm::dmat4& world_from_box) {
    const glm::dmat4 box_from_world = glm::inverse(world_from_box);
    std::vector<glm::dvec4> planes;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 above(0, 0, 0, -box.low[axis]);
        above[axis] = 1;
        glm::dvec4 below(0, 0, 0, box.high[axis]);
        below[axis] = -1;
        planes.push_back(glm::transpose(box_from_world) * above);
        planes.push_back(glm::transpose(box_from_world) * below);
    }
    return planes;
}

double least_side(const std::vector<glm::dvec4>& planes, const glm::dvec3& point) {
    double least = INFINITY;
    for (const glm::dvec4& plane : planes) least = std::min(least, side_of(plane, point));
    return least;
}

/// The corners of what all planes leave: wherever three of them meet, and no other cuts it off.
std::vector<glm::dvec3> corners_by_brute_force(const std::vector<glm::dvec4>& planes) {
    std::vector<glm::dvec3> corners;
    for (size_t i = 0; i < planes.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            for (size_t k = 0; k < j; ++k) {
                const glm::dmat3 normals = glm::transpose(glm::dmat3(glm::normalize(glm::dvec3(planes[i])),
                                                                     glm::normalize(glm::dvec3(planes[j])),
                                                                     glm::normalize(glm::dvec3(planes[k]))));
                if (std::abs(glm::determinant(normals)) < 1e-4) continue;
                const glm::dvec3 at(-side_of(planes[i], {}), -side_of(planes[j], {}), -side_of(planes[k], {}));
                const glm::dvec3 corner = glm::inverse(normals) * at;
                // Clearly not cut off: what only touches may be there or not.
                if (least_side(planes, corner) > -1e-12) corners.push_back(corner);
            }
        }
    }
    return corners;
}

double distance_to(const std::vector<glm::dvec3>& corners, const glm::dvec3& point) {
    double least = INFINITY;
    for (const glm::dvec3& corner : corners) least = std::min(least, glm::distance(corner, point));
    return least;
}

/// `touching` says whether planes may go right through corners, where rounding decides what remains of nothing.
void expect_cut(const Bounds& box, const glm::dmat4& world_from_box, const std::vector<glm::dvec4>& planes,
                bool touching) {
    const std::vector<glm::dvec3> corners = cut_corners({box}, world_from_box, planes);
    std::vector<glm::dvec4> all = planes_of(box, world_from_box);
    all.insert(all.end(), planes.begin(), planes.end());
    for (const glm::dvec3& corner : corners) RC_ASSERT(least_side(all, corner) > -1e-9);
    const std::vector<glm::dvec3> expected = corners_by_brute_force(all);
    // A body that is empty or a single point, edge or face may be told as either.
    glm::dvec3 middle(0);
    for (const glm::dvec3& corner : expected) middle += corner / static_cast<double>(expected.size());
    const bool solid = !expected.empty() && least_side(all, middle) > 1e-9;
    if (touching && !solid) return;
    RC_ASSERT(corners.empty() == expected.empty());
    for (const glm::dvec3& corner : expected) RC_ASSERT(distance_to(corners, corner) < 1e-7);
}

RC_GTEST_PROP(CutCorners, AreAllThatThePlanesLeave, ()) {
    Random random(*rc::gen::arbitrary<uint64_t>());
    const auto place = [&] { return glm::dvec3(random.normal(), random.normal(), random.normal()); };
    Bounds box;
    box.add(place());
    box.add(place());
    const glm::dvec3 axis = glm::normalize(place());
    glm::dmat4 world_from_box(1);
    const Basis turned = basis_towards(direction_of(axis));
    world_from_box[0] = glm::dvec4(turned.right, 0);
    world_from_box[1] = glm::dvec4(turned.up, 0);
    world_from_box[2] = glm::dvec4(turned.back, 0);
    world_from_box[3] = glm::dvec4(place(), 1);
    const glm::dvec3 middle(world_from_box * glm::dvec4(box.centre(), 1));
    std::vector<glm::dvec4> planes;
    const int count = *rc::gen::inRange(0, 7);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 normal = place() * std::exp2(6 * random.uniform() - 3);
        planes.emplace_back(normal, -glm::dot(normal, middle + 0.6 * place()));
    }
    expect_cut(box, world_from_box, planes, false);
}

// Whole numbers: planes along faces, through edges and corners, twice the same, of normals as short as a tenth.
RC_GTEST_PROP(CutCorners, TouchingPlanesLeaveNothingOut, ()) {
    const auto whole = [](int most) { return static_cast<double>(*rc::gen::inRange(-most, most + 1)); };
    Bounds box;
    box.add({whole(3), whole(3), whole(3)});
    box.add(box.low + glm::dvec3(*rc::gen::inRange(1, 4), *rc::gen::inRange(1, 4), *rc::gen::inRange(1, 4)));
    std::vector<glm::dvec4> planes;
    const int count = *rc::gen::inRange(1, 7);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 normal(whole(2), whole(2), whole(2));
        if (glm::length(normal) == 0) continue;
        planes.push_back(glm::dvec4(normal, whole(4)) * (*rc::gen::element(0.125, 1.0, 8.0)));
    }
    expect_cut(box, glm::dmat4(1), planes, true);
}

TEST(CutCorners, OfNothingAreNone) {
    Bounds box;
    box.add({0, 0, 0});
    box.add({1, 1, 1});
    EXPECT_TRUE(cut_corners({}, glm::dmat4(1), {}).empty());
    EXPECT_TRUE(cut_corners({box}, glm::dmat4(1), {{1, 0, 0, -2}}).empty());
    EXPECT_TRUE(cut_corners({box}, glm::dmat4(1), {{1, 0, 0, -0.6}, {-1, 0, 0, 0.4}}).empty());
    EXPECT_FALSE(cut_corners({box}, glm::dmat4(1), {}).empty());
}

// Two cuts of which the second runs through the face that the first made, by planes with short normals along an axis.
TEST(CutCorners, ShortNormalsCutLikeLongOnes) {
    Bounds box;
    box.add({0, 0, 0});
    box.add({1, 1, 1});
    for (const double length : {1e-3, 0.3, 1.0, 1e3}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec4 first(0, 0, 0, -0.5);
            first[axis] = 1;
            glm::dvec4 second(-1, -1, -1, 1.2);
            const auto corners = cut_corners({box}, glm::dmat4(1), {length * first, second});
            // Where the first's plane meets the second's and the sides of the box.
            glm::dvec3 far(0);
            far[axis] = 0.5;
            far[(axis + 1) % 3] = 0.7;
            EXPECT_LT(distance_to(corners, far), 1e-12) << length << " " << axis;
            for (const glm::dvec3& corner : corners) EXPECT_GE(side_of(second, corner), -1e-12);
        }
    }
}

// Inside all planes is what lands in the picture.
RC_GTEST_PROP(ViewPlanes, AgreeWithClipSpace, ()) {
    Random random(*rc::gen::arbitrary<uint64_t>());
    const auto place = [&] { return 3.0 * glm::dvec3(random.normal(), random.normal(), random.normal()); };
    const Camera camera = camera_looking_at(place(), place(), 20 + 80 * random.uniform(), 0.3 + random.uniform(),
                                            4 + 9 * random.uniform());
    const double aspect = 0.5 + 2 * random.uniform();
    const glm::dmat4 clip(clip_from_world(camera, aspect));
    const std::vector<glm::dvec4> planes = view_planes(camera, aspect);
    RC_ASSERT(planes.size() == 6u);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 point = camera.eye - 10 * random.uniform() * camera.basis.back + place();
        const glm::dvec4 p = clip * glm::dvec4(point, 1);
        const double inside = std::min({p.w - p.x, p.w + p.x, p.w - p.y, p.w + p.y, p.w - p.z, p.z});
        if (std::abs(inside) < 1e-4) continue;
        RC_ASSERT((inside > 0) == (least_side(planes, point) > 0));
    }
}

TEST(SceneExtents, GathersPartsByMover) {
    std::vector<Mesh> meshes = made::box({0, 0, 0}, {1, 1, 1});
    meshes.push_back(made::ground(-1, 9));
    meshes.push_back(made::polygon({{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, true));
    meshes.back().mover = 1;
    meshes.push_back({});
    // A vertex that no triangle uses reaches nowhere.
    meshes[0].vertices.push_back({{100, 100, 100}, {0, 1, 0}, {0, 0}});
    const SceneExtents extents = extents_of(made::scene_of(meshes));
    ASSERT_EQ(extents.parts.size(), 3u);
    EXPECT_EQ(extents.parts[0].casters.size(), 8u) << "the box's corners, each once";
    EXPECT_EQ(extents.parts[0].meshes.size(), 7u);
    EXPECT_TRUE(extents.parts[1].casters.empty());
    EXPECT_TRUE(extents.parts[1].meshes.empty());
    EXPECT_EQ(extents.parts[2].casters.size(), 3u);
    EXPECT_EQ(extents.parts[0].meshes[0].high, glm::dvec3(0, 1, 1)) << "the box's side at x = 0";
}

}  // namespace
}  // namespace stairstep
