#include "renderer/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

using Triangle = std::array<uint32_t, 3>;

std::vector<Triangle> triangles_of(const std::vector<uint32_t>& indices) {
    std::vector<Triangle> triangles;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
}

glm::dvec3 random_point(Random& random, double half_side) {
    const auto place = [&] { return half_side * (2 * random.uniform() - 1); };
    return {place(), place(), place()};
}

/// Small triangles all over a cube, or in one place, or on a line.
FacetMesh random_soup(Random& random, size_t count) {
    FacetMesh mesh;
    const uint64_t kind = random.below(3);
    for (size_t i = 0; i < count; ++i) {
        glm::dvec3 middle = random_point(random, 10);
        if (kind == 1) middle = glm::dvec3(1, 2, 3);
        if (kind == 2) middle *= glm::dvec3(0, 0, 1);
        for (int corner = 0; corner < 3; ++corner) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back({{glm::vec3(middle + random_point(random, 0.3)), {0, 1, 0}, {0, 0}}, {}});
        }
    }
    return mesh;
}

TEST(Clusters, HoldEveryTriangleOnceAsItIs) {
    Random random(1);
    for (const size_t count : {0, 1, 2, 255, 256, 257, 512, 513, 5000}) {
        FacetMesh mesh = random_soup(random, count);
        std::vector<Triangle> before = triangles_of(mesh.indices);
        const std::vector<Cluster> clusters = make_clusters(mesh);
        std::vector<Triangle> after = triangles_of(mesh.indices);
        std::sort(before.begin(), before.end());
        std::sort(after.begin(), after.end());
        EXPECT_EQ(after, before) << count;
        size_t next = 0;
        for (const Cluster& cluster : clusters) {
            EXPECT_EQ(cluster.first_index, next);
            EXPECT_GT(cluster.index_count, 0u);
            EXPECT_EQ(cluster.index_count % 3, 0u);
            EXPECT_LE(cluster.index_count, 3 * kClusterTriangles);
            next += cluster.index_count;
        }
        EXPECT_EQ(next, mesh.indices.size());
        // Halves of what is more than a cluster are no less than half of one.
        EXPECT_LE(clusters.size(), std::max<size_t>(1, 2 * count / kClusterTriangles + 1)) << count;
    }
}

TEST(Clusters, BoundsHoldTheirTrianglesAndNoMore) {
    Random random(2);
    for (int run = 0; run < 5; ++run) {
        FacetMesh mesh = random_soup(random, 1500);
        for (const Cluster& cluster : make_clusters(mesh)) {
            Bounds bounds;
            for (size_t i = 0; i < cluster.index_count; ++i) {
                bounds.add(mesh.vertices[mesh.indices[cluster.first_index + i]].vertex.position);
            }
            EXPECT_EQ(cluster.bounds.low, bounds.low);
            EXPECT_EQ(cluster.bounds.high, bounds.high);
        }
    }
}

TEST(Clusters, RunsHoldEveryTriangleWithACornerWithin) {
    Random random(3);
    size_t left_out = 0;
    for (int run = 0; run < 40; ++run) {
        FacetMesh mesh = random_soup(random, 1 + random.below(4000));
        const std::vector<Cluster> clusters = make_clusters(mesh);
        for (int volume = 0; volume < 10; ++volume) {
            std::vector<glm::dvec4> planes(random.below(7));
            for (glm::dvec4& plane : planes) {
                plane = glm::dvec4(random_point(random, 1), 12 * random.uniform() - 6);
            }
            const std::vector<IndexRun> runs = runs_within(clusters, planes);
            std::vector<bool> is_drawn(mesh.indices.size() / 3, false);
            size_t end = 0;
            for (const IndexRun& one : runs) {
                // In order, and joined where they touch.
                if (&one != runs.data()) {
                    ASSERT_GT(one.first_index, end);
                }
                end = one.first_index + one.index_count;
                ASSERT_LE(end, mesh.indices.size());
                ASSERT_EQ(one.first_index % 3 + one.index_count % 3, 0u);
                std::fill(is_drawn.begin() + one.first_index / 3, is_drawn.begin() + end / 3, true);
            }
            for (size_t i = 0; i < mesh.indices.size(); ++i) {
                const glm::dvec4 corner(mesh.vertices[mesh.indices[i]].vertex.position, 1);
                const bool is_within = std::all_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
                    return glm::dot(plane, corner) >= 0;
                });
                if (is_within) {
                    ASSERT_TRUE(is_drawn[i / 3]);
                }
            }
            left_out += std::count(is_drawn.begin(), is_drawn.end(), false);
            if (planes.empty()) {
                ASSERT_EQ(runs, (std::vector<IndexRun>{{0, mesh.indices.size()}}));
            }
        }
    }
    EXPECT_GT(left_out, 100'000u);
}

TEST(Clusters, InOrderAreTheSameAndReachFartherAndFarther) {
    Random random(4);
    for (int run = 0; run < 20; ++run) {
        FacetMesh mesh = random_soup(random, 1 + random.below(4000));
        const std::vector<Cluster> clusters = make_clusters(mesh);
        const glm::dvec4 front(random_point(random, 1), 3);
        const std::vector<glm::dvec4> planes(run % 2, glm::dvec4(random_point(random, 1), 2));
        const OrderedRuns ordered = runs_from(front, clusters, planes);

        const auto indices_in = [](const std::vector<IndexRun>& runs) {
            std::vector<size_t> indices;
            for (const IndexRun& one : runs) {
                for (size_t i = 0; i < one.index_count; ++i) indices.push_back(one.first_index + i);
            }
            return indices;
        };
        const std::vector<size_t> in_order = indices_in(ordered.runs);
        std::vector<size_t> sorted = in_order;
        std::sort(sorted.begin(), sorted.end());
        EXPECT_EQ(sorted, indices_in(runs_within(clusters, planes)));

        // A cluster's own reach, by its eight corners.
        const auto reach_of = [&](size_t index) {
            const auto after = std::upper_bound(clusters.begin(), clusters.end(), index,
                                                [](size_t i, const Cluster& one) { return i < one.first_index; });
            double reach = -INFINITY;
            for (int i = 0; i < 8; ++i) {
                reach = std::max(reach, glm::dot(front, glm::dvec4(std::prev(after)->bounds.corner(i), 1)));
            }
            return reach;
        };
        double last = -INFINITY;
        for (const size_t index : in_order) {
            EXPECT_GE(reach_of(index), last - 1e-9);
            last = reach_of(index);
        }
        EXPECT_NEAR(ordered.farthest, in_order.empty() ? -INFINITY : last, 1e-9);
    }
}

// A sheet of n × n squares: a volume that holds a share of it needn't draw much more than that share.
TEST(Clusters, LeaveOutWhatIsFarFromAVolume) {
    constexpr int kSquares = 128;
    Mesh sheet;
    for (int z = 0; z <= kSquares; ++z) {
        for (int x = 0; x <= kSquares; ++x) {
            sheet.vertices.push_back({glm::vec3(x, 0, z) / static_cast<float>(kSquares), {0, 1, 0}, {0, 0}});
        }
    }
    const auto at = [](int x, int z) { return static_cast<uint32_t>(z * (kSquares + 1) + x); };
    for (int z = 0; z < kSquares; ++z) {
        for (int x = 0; x < kSquares; ++x) {
            sheet.indices.insert(sheet.indices.end(),
                                 {at(x, z), at(x, z + 1), at(x + 1, z), at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
        }
    }
    FacetMesh mesh = facet_mesh(sheet);
    const std::vector<Cluster> clusters = make_clusters(mesh);
    // The quarter of it with x and z below 1/2, a plane each.
    const std::vector<glm::dvec4> planes{{-1, 0, 0, 0.49}, {0, 0, -1, 0.49}};
    size_t drawn = 0;
    for (const IndexRun& run : runs_within(clusters, planes)) drawn += run.index_count;
    EXPECT_GE(drawn, mesh.indices.size() * 0.49 * 0.49);
    EXPECT_LE(drawn, mesh.indices.size() * 0.26);
}

}  // namespace
}  // namespace stairstep
