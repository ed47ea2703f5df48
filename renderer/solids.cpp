#include "renderer/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace stairstep {
namespace {

using Corners = std::array<uint32_t, 3>;

/// Less than this share of its box is rounding's.
constexpr double kLeastVolume = 1e-9;
/// Share of a box's diagonal.
constexpr double kSlack = 1e-5;

/// Of the largest coordinate: what floats there tell apart, and some bits more. A sphere's seam and poles are closed but for
/// their roundings.
constexpr int kGridBits = 22;

struct GridHash {
    size_t operator()(const glm::ivec3& place) const {
        uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            hash = (hash ^ static_cast<uint32_t>(place[axis])) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

/// The triangles' corners, those in one place of the grid having one number, from 0 on.
struct Welded {
    std::vector<Corners> triangles;
    std::vector<glm::dvec3> places;
};

Welded weld(const FacetMesh& mesh) {
    Welded welded;
    float largest = 0;
    for (const uint32_t index : mesh.indices) {
        const glm::vec3 place = glm::abs(mesh.vertices[index].vertex.position);
        largest = std::max({largest, place.x, place.y, place.z});
    }
    const double step = largest > 0 ? std::ldexp(static_cast<double>(largest), -kGridBits) : 1;
    std::unordered_map<glm::ivec3, uint32_t, GridHash> numbers;
    welded.triangles.resize(mesh.indices.size() / 3);
    for (size_t i = 0; i < 3 * welded.triangles.size(); ++i) {
        const glm::vec3& place = mesh.vertices[mesh.indices[i]].vertex.position;
        const auto [entry, is_new] = numbers.try_emplace(glm::ivec3(glm::round(glm::dvec3(place) / step)),
                                                         static_cast<uint32_t>(numbers.size()));
        if (is_new) welded.places.emplace_back(place);
        welded.triangles[i / 3][i % 3] = entry->second;
    }
    return welded;
}

/// Of each place, a number that all places of its part have in common.
std::vector<uint32_t> parts_of(const Welded& welded) {
    std::vector<uint32_t> part(welded.places.size());
    std::iota(part.begin(), part.end(), 0u);
    const auto root = [&](uint32_t place) {
        while (part[place] != place) place = part[place] = part[part[place]];
        return place;
    };
    for (const Corners& corners : welded.triangles) {
        for (const int other : {1, 2}) part[root(corners[other])] = root(corners[0]);
    }
    for (uint32_t& place : part) place = root(place);
    return part;
}

/// An edge, from its lower number to its higher, and which way a triangle goes along it.
struct Edge {
    uint32_t low;
    uint32_t high;
    int way;
};

/// Marks the parts that have edges gone along more often one way than the other.
std::vector<bool> open_parts(const Welded& welded, const std::vector<uint32_t>& parts) {
    std::vector<Edge> edges;
    edges.reserve(3 * welded.triangles.size());
    for (const Corners& corners : welded.triangles) {
        for (int i = 0; i < 3; ++i) {
            const uint32_t from = corners[i];
            const uint32_t to = corners[(i + 1) % 3];
            if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
    std::vector<bool> open(welded.places.size(), false);
    for (size_t first = 0, end = 0; first < edges.size(); first = end) {
        int balance = 0;
        while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high) {
            balance += edges[end++].way;
        }
        if (balance != 0) open[parts[edges[first].low]] = true;
    }
    return open;
}

}  // namespace

Solids find_solids(const FacetMesh& mesh) {
    const Welded welded = weld(mesh);
    const std::vector<uint32_t> parts = parts_of(welded);
    const std::vector<bool> open = open_parts(welded, parts);

    std::vector<Bounds> bounds(welded.places.size());
    for (size_t i = 0; i < parts.size(); ++i) bounds[parts[i]].add(welded.places[i]);
    std::vector<double> volume(welded.places.size(), 0);
    for (const Corners& corners : welded.triangles) {
        const uint32_t part = parts[corners[0]];
        const glm::dvec3 middle = bounds[part].centre();
        const auto from_middle = [&](int i) { return welded.places[corners[i]] - middle; };
        volume[part] += glm::dot(from_middle(0), glm::cross(from_middle(1), from_middle(2))) / 6;
    }

    Solids solids;
    std::vector<bool> is_solid(welded.places.size(), false);
    for (size_t i = 0; i < parts.size(); ++i) {
        const double diagonal = bounds[i].empty() ? 0 : bounds[i].diagonal();
        if (parts[i] != i || open[i] || !(volume[i] > kLeastVolume * diagonal * diagonal * diagonal)) continue;
        is_solid[i] = true;
        solids.bounds.push_back(bounds[i]);
    }
    for (const Corners& corners : welded.triangles) solids.has_triangle.push_back(is_solid[parts[corners[0]]]);
    return solids;
}

bool may_hold(std::span<const Bounds> solids, std::span<const glm::dvec3> points) {
    Bounds hull;
    for (const glm::dvec3& point : points) hull.add(point);
    if (hull.empty()) return false;
    return std::any_of(solids.begin(), solids.end(), [&](const Bounds& solid) {
        const double slack = kSlack * (solid.diagonal() + glm::length(hull.high) + glm::length(hull.low));
        return glm::all(glm::lessThanEqual(solid.low - slack, hull.high)) &&
               glm::all(glm::lessThanEqual(hull.low, solid.high + slack));
    });
}

}  // namespace stairstep
