#include "renderer/truth/ray_tracer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

/// Triangle over a square's half at this height, seen from above over x > z.
WorldMesh half_square(float y, bool casts) {
    return {{{-1, y, -1}, {1, y, 1}, {1, y, -1}}, {0, 1, 2}, casts};
}

TEST(RayTracer, FindsTheNearestTriangleInItsRange) {
    const WorldMesh two{{{-1, 0, -1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, 1}}, {0, 1, 2, 0, 3, 1}, true};
    // Meshes without triangles keep their place.
    const RayTracer tracer({WorldMesh{}, half_square(1, false), two});
    const glm::dvec3 down(0, -2, 0);
    auto hit = tracer.nearest({0.5, 3, -0.5}, down, 0, 10);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mesh, 1u);
    EXPECT_NEAR(hit->distance, 1, 1e-6) << "in lengths of the direction";
    hit = tracer.nearest({0.5, 3, -0.5}, down, 1.1, 10);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mesh, 2u);
    EXPECT_EQ(hit->triangle, 0u);
    EXPECT_NEAR(hit->distance, 1.5, 1e-6);
    hit = tracer.nearest({-0.5, 3, 0.5}, down, 0, 10);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 1u);
    EXPECT_FALSE(tracer.nearest({0.5, 3, -0.5}, down, 0, 0.9));
    EXPECT_FALSE(tracer.nearest({1.5, 3, -0.5}, down, 0, 10));
}

TEST(RayTracer, CountsRaysThatNoCasterStops) {
    const RayTracer tracer({half_square(1, true), half_square(2, false)});
    for (int count = 0; count <= RayPacket::kSize; ++count) {
        RayPacket packet;
        // Every third ray goes to the covered half.
        for (int i = 0; i < count; ++i) {
            packet.add(i % 3 == 0 ? glm::dvec3(0.3, 2, -0.1 - 0.01 * i) : glm::dvec3(-0.1 - 0.01 * i, 2, 0.3));
        }
        const int stopped = (count + 2) / 3;
        EXPECT_EQ(tracer.unoccluded({0, 0, 0}, packet, INFINITY), count - stopped);
        EXPECT_EQ(tracer.unoccluded({0, 0, 0}, packet, 0.51), count - stopped);
        EXPECT_EQ(tracer.unoccluded({0, 0, 0}, packet, 0.49), count) << "the ray ends below";
        EXPECT_EQ(tracer.unoccluded({0, 1.5, 0}, packet, INFINITY), count) << "the ray begins above";
    }
}

TEST(RayTracer, KnowsWhenOneTriangleStopsAll) {
    const WorldMesh square{{{-1, 2, -1}, {-1, 2, 1}, {1, 2, 1}, {1, 2, -1}}, {0, 1, 2, 0, 2, 3}, true};
    const auto stops = [](const RayTracer& tracer, double x, double z, double length) {
        RayPacket packet;
        for (const double u : {-0.1, 0.1}) {
            for (const double v : {-0.1, 0.1}) packet.add({u, 1, v});
        }
        return tracer.one_triangle_stops_all({x, 0, z}, packet, length);
    };
    const RayTracer tracer({half_square(1, false), square});
    EXPECT_TRUE(stops(tracer, -0.6, 0.3, INFINITY));
    EXPECT_TRUE(stops(tracer, 0.3, -0.6, INFINITY)) << "what doesn't cast is not in the way";
    EXPECT_FALSE(stops(tracer, -0.6, 0.3, 1.9)) << "the rays end below";
    EXPECT_FALSE(stops(tracer, 0.1, 0.1, INFINITY)) << "two triangles";
    EXPECT_FALSE(stops(tracer, -0.9, 0.3, INFINITY)) << "some pass by";
    EXPECT_FALSE(stops(tracer, 3, 3, INFINITY));
}

TEST(RayTracer, RaysDontSlipThroughSharedEdges) {
    // A plane of 32 × 32 squares, their corners at odd floats; rays go through the corners and edges themselves.
    constexpr int kSide = 32;
    WorldMesh plane;
    const auto at = [](int i) { return 0.1f * static_cast<float>(i) - 1.7f; };
    for (int z = 0; z <= kSide; ++z) {
        for (int x = 0; x <= kSide; ++x) plane.positions.emplace_back(at(x), 1.0f, at(z));
    }
    for (uint32_t z = 0; z < kSide; ++z) {
        for (uint32_t x = 0; x < kSide; ++x) {
            const uint32_t corner = z * (kSide + 1) + x;
            plane.indices.insert(plane.indices.end(), {corner, corner + kSide + 1, corner + kSide + 2, corner,
                                                       corner + kSide + 2, corner + 1});
        }
    }
    const RayTracer tracer({plane});
    const glm::dvec3 origin(0.123, 0, -0.087);
    for (int z = 2; z < 2 * kSide - 1; ++z) {
        for (int x = 2; x < 2 * kSide - 1; ++x) {
            // Corners and the middles between them.
            const glm::dvec3 target(0.5 * (at(x / 2) + at((x + 1) / 2)), 1, 0.5 * (at(z / 2) + at((z + 1) / 2)));
            RayPacket packet;
            packet.add(target - origin);
            EXPECT_EQ(tracer.unoccluded(origin, packet, 2), 0) << x << " " << z;
        }
    }
}

}  // namespace
}  // namespace stairstep
