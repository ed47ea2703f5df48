#include "renderer/scenes/mesh_shapes.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace stairstep {
namespace {

/// Sides that meet at less than this are one curve.
const double kCreaseCosine = std::cos(40 * std::numbers::pi / 180);

glm::dvec2 outward(const glm::dvec2& from, const glm::dvec2& to) {
    return glm::normalize(glm::dvec2(to.y - from.y, from.x - to.x));
}

/// Normal of one side of a sweep between two neighbouring values, bent towards `other` where both are of one curve.
template <typename Vector>
Vector shaded(const Vector& own, const Vector& other) {
    return glm::dot(own, other) > kCreaseCosine ? glm::normalize(own + other) : own;
}

/// Collects vertices in world space.
class Builder {
  public:
    Builder(Mesh& mesh, const glm::dmat4& world_from_shape)
        : mesh_(mesh), world_from_shape_(world_from_shape), rotation_(world_from_shape) {}

    uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal) {
        Vertex vertex;
        vertex.position = glm::vec3(glm::dvec3(world_from_shape_ * glm::dvec4(position, 1)));
        vertex.normal = glm::vec3(glm::normalize(rotation_ * normal));
        mesh_.vertices.push_back(vertex);
        return static_cast<uint32_t>(mesh_.vertices.size() - 1);
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c) { mesh_.indices.insert(mesh_.indices.end(), {a, b, c}); }

  private:
    Mesh& mesh_;
    glm::dmat4 world_from_shape_;
    glm::dmat3 rotation_;
};

/// A fan over the outline at a section, seen from +z or −z.
void append_cap(Builder& builder, const std::vector<glm::dvec2>& outline, const Section& section, bool top) {
    if (section.scale == 0) return;
    const glm::dvec3 normal(0, 0, top ? 1 : -1);
    std::vector<uint32_t> ring;
    for (const glm::dvec2& corner : outline) {
        ring.push_back(builder.vertex({section.scale * corner, section.z}, normal));
    }
    // Triangles and rectangles need no middle.
    const bool fan_from_corner = outline.size() <= 4;
    const uint32_t middle = fan_from_corner ? ring[0] : builder.vertex({0, 0, section.z}, normal);
    const size_t first = fan_from_corner ? 1 : 0;
    const size_t last = fan_from_corner ? ring.size() - 1 : ring.size();
    for (size_t i = first; i < last; ++i) {
        const uint32_t a = ring[i];
        const uint32_t b = ring[(i + 1) % ring.size()];
        if (top) {
            builder.triangle(middle, a, b);
        } else {
            builder.triangle(middle, b, a);
        }
    }
}

/// Columns of a rotation.
glm::dmat4 transform(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& origin) {
    return glm::dmat4(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1));
}

std::vector<glm::dvec2> rectangle(double half_x, double half_y) {
    return {{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}};
}

}  // namespace

void append_sweep(Mesh& mesh, const std::vector<glm::dvec2>& outline, std::span<const Section> sections,
                  const glm::dmat4& world_from_shape) {
    assert(outline.size() >= 3 && sections.size() >= 2);
    Builder builder(mesh, world_from_shape);
    const size_t count = outline.size();
    const auto corner = [&](size_t i) { return outline[i % count]; };

    // Normals of the band between sections j and j + 1 along side i: the outline's own, tilted by the taper. The side
    // lies at h from the axis, and at s·h in a section, so (n, −slope·h) is perpendicular to it.
    const auto band_normal = [&](const glm::dvec2& across, double height_of_side, size_t j) {
        const double slope = (sections[j + 1].scale - sections[j].scale) / (sections[j + 1].z - sections[j].z);
        return glm::normalize(glm::dvec3(across, -slope * height_of_side));
    };
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec2 own = outward(corner(i), corner(i + 1));
        const glm::dvec2 start = shaded(own, outward(corner(i + count - 1), corner(i)));
        const glm::dvec2 end = shaded(own, outward(corner(i + 1), corner(i + 2)));
        const double height = glm::dot(own, corner(i));
        for (size_t j = 0; j + 1 < sections.size(); ++j) {
            const Section& low = sections[j];
            const Section& high = sections[j + 1];
            const auto normal = [&](const glm::dvec2& across, size_t neighbour) {
                const glm::dvec3 band = band_normal(across, height, j);
                return neighbour < sections.size() - 1 ? shaded(band, band_normal(across, height, neighbour)) : band;
            };
            // Wraps to a value out of range below the first band.
            const size_t below = j - 1;
            std::vector<uint32_t> quad;
            quad.push_back(builder.vertex({low.scale * corner(i), low.z}, normal(start, below)));
            quad.push_back(builder.vertex({low.scale * corner(i + 1), low.z}, normal(end, below)));
            quad.push_back(builder.vertex({high.scale * corner(i + 1), high.z}, normal(end, j + 1)));
            quad.push_back(builder.vertex({high.scale * corner(i), high.z}, normal(start, j + 1)));
            // At a tip one of the two has no area.
            if (low.scale > 0) builder.triangle(quad[0], quad[1], quad[2]);
            if (high.scale > 0) builder.triangle(quad[0], quad[2], quad[3]);
        }
    }
    append_cap(builder, outline, sections.front(), false);
    append_cap(builder, outline, sections.back(), true);
}

std::vector<glm::dvec2> regular_outline(double radius, int sides) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
}

void append_box(Mesh& mesh, const glm::dvec3& half_size, const glm::dmat4& world_from_box) {
    const Section sections[] = {{-half_size.z, 1}, {half_size.z, 1}};
    append_sweep(mesh, rectangle(half_size.x, half_size.y), sections, world_from_box);
}

void append_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
    append_box(mesh, 0.5 * (high - low), glm::translate(glm::dmat4(1), 0.5 * (low + high)));
}

void append_beam(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double width) {
    const double half = glm::length(to - from) / 2;
    append_box(mesh, {width / 2, width / 2, half}, frame_along(0.5 * (from + to), to - from));
}

void append_cylinder(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius_from, double radius_to,
                     int sides) {
    const double largest = std::max(radius_from, radius_to);
    const Section sections[] = {{0, radius_from / largest}, {glm::length(to - from), radius_to / largest}};
    append_sweep(mesh, regular_outline(largest, sides), sections, frame_along(from, to - from));
}

void append_turned(Mesh& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> radius_and_height, int sides) {
    std::vector<Section> sections;
    for (const glm::dvec2& point : radius_and_height) sections.push_back({point.y, point.x});
    append_sweep(mesh, regular_outline(1, sides), sections, frame_along(foot, {0, 1, 0}));
}

void append_grid(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int cells_u,
                 int cells_v) {
    Builder builder(mesh, glm::dmat4(1));
    const glm::dvec3 normal = glm::cross(u, v);
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (int j = 0; j <= cells_v; ++j) {
        for (int i = 0; i <= cells_u; ++i) {
            builder.vertex(corner + u * (static_cast<double>(i) / cells_u) + v * (static_cast<double>(j) / cells_v),
                           normal);
        }
    }
    const auto row = static_cast<uint32_t>(cells_u + 1);
    for (uint32_t j = 0; j < static_cast<uint32_t>(cells_v); ++j) {
        for (uint32_t i = 0; i < static_cast<uint32_t>(cells_u); ++i) {
            const uint32_t a = first + j * row + i;
            builder.triangle(a, a + 1, a + row + 1);
            builder.triangle(a, a + row + 1, a + row);
        }
    }
}

glm::dmat4 frame_along(const glm::dvec3& origin, const glm::dvec3& axis) {
    const Basis basis = basis_towards(direction_of(axis));
    return transform(basis.right, basis.up, basis.back, origin);
}

glm::dmat4 turn_about(const glm::dvec3& point, double angle_deg) {
    return rotate_about(point, {0, 1, 0}, angle_deg);
}

glm::dmat4 rotate_about(const glm::dvec3& point, const glm::dvec3& axis, double angle_deg) {
    const glm::dmat4 to = glm::translate(glm::dmat4(1), point);
    return glm::translate(glm::rotate(to, angle_deg * std::numbers::pi / 180, axis), -point);
}

}  // namespace stairstep
