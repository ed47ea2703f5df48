#include "renderer/scene_extents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace stairstep {
namespace {

using Polygon = std::vector<glm::dvec3>;

double side(const glm::dvec4& plane, const glm::dvec3& point) {
    return glm::dot(glm::dvec3(plane), point) + plane.w;
}

/// The part of a convex polygon on the plane's inner side (Sutherland & Hodgman 1974); corners made on the plane are
/// also added to `cap`.
Polygon cut(const Polygon& polygon, const glm::dvec4& plane, Polygon& cap) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double side_a = side(plane, a);
        const double side_b = side(plane, b);
        if (side_a >= 0) kept.push_back(a);
        if ((side_a >= 0) != (side_b >= 0)) {
            kept.push_back(a + side_a / (side_a - side_b) * (b - a));
            cap.push_back(kept.back());
        }
    }
    return kept;
}

/// The corners of a cap, which all lie in the plane, in order around it.
Polygon in_order(Polygon cap, const glm::dvec3& normal) {
    if (cap.size() < 3) return {};
    glm::dvec3 middle(0);
    for (const glm::dvec3& corner : cap) middle += corner / static_cast<double>(cap.size());
    const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::cross(normal, axis);
    const glm::dvec3 v = glm::cross(normal, u);
    std::sort(cap.begin(), cap.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return std::atan2(glm::dot(a - middle, v), glm::dot(a - middle, u)) <
               std::atan2(glm::dot(b - middle, v), glm::dot(b - middle, u));
    });
    return cap;
}

std::vector<Polygon> faces_of(const Bounds& box, const glm::dmat4& world_from_box) {
    // Corner i of Bounds::corner has bit 0 for x, 1 for y, 2 for z.
    constexpr std::array<std::array<int, 4>, 6> kFaces{
        {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}}};
    std::vector<Polygon> faces;
    for (const auto& face : kFaces) {
        Polygon polygon;
        for (const int corner : face) polygon.emplace_back(world_from_box * glm::dvec4(box.corner(corner), 1));
        faces.push_back(std::move(polygon));
    }
    return faces;
}

}  // namespace

SceneExtents extents_of(const Scene& scene) {
    SceneExtents extents;
    extents.parts.resize(1);
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.indices.empty()) continue;
        const size_t part = mesh.mover ? *mesh.mover + 1 : 0;
        if (part >= extents.parts.size()) extents.parts.resize(part + 1);
        Bounds bounds;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            if (!is_finite_triangle(mesh, i)) continue;
            for (size_t corner = i; corner < i + 3; ++corner) {
                const glm::vec3& position = mesh.vertices[mesh.indices[corner]].position;
                bounds.add(position);
                if (mesh.casts) extents.parts[part].casters.push_back(position);
            }
        }
        if (!bounds.empty()) extents.parts[part].meshes.push_back(bounds);
    }
    for (SceneExtents::Part& part : extents.parts) {
        const auto key = [](const glm::vec3& p) { return std::tuple(p.x, p.y, p.z); };
        std::sort(part.casters.begin(), part.casters.end(),
                  [&](const glm::vec3& a, const glm::vec3& b) { return key(a) < key(b); });
        part.casters.erase(std::unique(part.casters.begin(), part.casters.end()), part.casters.end());
        part.casters.shrink_to_fit();
    }
    return extents;
}

std::vector<glm::dvec3> cut_corners(const std::vector<Bounds>& boxes, const glm::dmat4& world_from_box,
                                    const std::vector<glm::dvec4>& planes) {
    std::vector<glm::dvec3> corners;
    for (const Bounds& box : boxes) {
        std::vector<Polygon> faces = faces_of(box, world_from_box);
        for (const glm::dvec4& plane : planes) {
            Polygon cap;
            std::vector<Polygon> kept;
            for (const Polygon& face : faces) {
                Polygon part = cut(face, plane, cap);
                if (part.size() >= 3) kept.push_back(std::move(part));
            }
            Polygon closing = in_order(std::move(cap), glm::dvec3(plane));
            if (!closing.empty()) kept.push_back(std::move(closing));
            faces = std::move(kept);
            if (faces.empty()) break;
        }
        for (const Polygon& face : faces) corners.insert(corners.end(), face.begin(), face.end());
    }
    return corners;
}

std::vector<glm::dvec4> view_planes(const Camera& camera, double aspect) {
    const auto& [right, up, back] = camera.basis;
    const double y = std::tan(camera.vertical_fov_deg * std::numbers::pi / 360);
    const double x = y * aspect;
    std::vector<glm::dvec4> planes;
    for (const glm::dvec3& inward : {-right - x * back, right - x * back, -up - y * back, up - y * back}) {
        planes.emplace_back(inward, -glm::dot(inward, camera.eye));
    }
    planes.emplace_back(-back, glm::dot(back, camera.eye) - camera.near);
    planes.emplace_back(back, camera.far - glm::dot(back, camera.eye));
    return planes;
}

}  // namespace stairstep
