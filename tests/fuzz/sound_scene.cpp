#include "tests/fuzz/sound_scene.h"

#include <cmath>

#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

template <typename Vector>
bool finite(const Vector& v) {
    for (int i = 0; i < v.length(); ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

bool finite(const Basis& basis) {
    return finite(basis.right) && finite(basis.up) && finite(basis.back);
}

void require_sound(const Mesh& mesh, const Scene& scene) {
    require(mesh.material < scene.materials.size(), "a mesh's material is there");
    require(mesh.indices.size() % 3 == 0 && !mesh.mover, "a mesh has whole triangles, and stands still");
    for (const uint32_t index : mesh.indices) require(index < mesh.vertices.size(), "an index leads to a vertex");
    for (const Vertex& vertex : mesh.vertices) {
        require(finite(vertex.position) && finite(vertex.normal) && finite(vertex.uv), "a vertex is finite");
        require(glm::all(glm::lessThanEqual(glm::abs(vertex.position), glm::vec3(1e12f))), "a vertex is within 10^12");
    }
}

}  // namespace

void require_sound(const ImportedScene& imported) {
    const Scene& scene = imported.scene;
    for (const Mesh& mesh : scene.meshes) require_sound(mesh, scene);
    for (const Material& material : scene.materials) {
        require(finite(material.base_colour), "a colour is finite");
        require(!material.texture || *material.texture < scene.textures.size(), "a material's texture is there");
    }
    for (const Image& image : scene.textures) {
        require(image.width > 0 && image.height > 0, "a texture has pixels");
        require(image.channels == 1 || image.channels == 3, "a texture is grey or RGB");
        require(image.pixels.size() == static_cast<size_t>(image.width) * image.height * image.channels,
                "a texture has as many pixels as it says");
    }
    for (const Camera& camera : imported.cameras) {
        require(finite(camera.eye) && finite(camera.basis), "a camera is finite");
        require(camera.near > 0 && camera.near < camera.far && std::isfinite(camera.far), "a camera's planes follow");
        require(camera.vertical_fov_deg > 0 && camera.vertical_fov_deg < 180,
                "a field of view lies in (0, 180) degrees");
    }
    for (const Light& light : imported.lights) {
        require(light.kind == Light::Kind::directional || light.kind == Light::Kind::spot, "a light is of a kind");
        require(finite(light.position) && finite(light.basis), "a light is finite");
        require(light.half_side >= 0 && std::isfinite(light.half_side), "a light's side is 0 or above");
        require(light.distance > 0 && std::isfinite(light.distance), "a light's distance is above 0");
        require(light.cone_deg > 0 && light.cone_deg <= 85, "a cone lies in (0, 85] degrees");
    }
}

}  // namespace stairstep::fuzz
