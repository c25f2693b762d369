// Writes triangles with textures as binary glTF 2.0 (.glb), one file that viewers and 3D programs open.
// `terrane export` calls it, for the models of glb_mesh.h. The functions have no state; any thread may call
// them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::formats {

// The format's axes: y is up, v counts down from the upper edge of the texture.
struct GlbVertex {
    glm::vec3 position{0}, normal{0};
    glm::vec2 uv{0};
};
static_assert(sizeof(GlbVertex) == 32, "vertices are written as they lie in memory");

enum class GlbAlpha : std::uint8_t { Opaque, Mask, Blend };

struct GlbImage {
    std::string name, png;
};

// Triangles of one material. Textures repeat and are not smoothed when magnified.
struct GlbPart {
    std::string name;
    std::size_t image = 0;
    int glow = -1;  // index of the image of the emitted light; -1: none
    GlbAlpha alpha = GlbAlpha::Opaque;
    bool isTwoSided = false;
    std::vector<GlbVertex> vertices;
    std::vector<std::uint32_t> indices;  // three per triangle, counterclockwise seen from outside
};

struct GlbModel {
    std::string name;
    std::vector<GlbImage> images;
    std::vector<GlbPart> parts;
};

// Returns the bytes of the whole file. The error is BadInput if there are no parts or one has no triangles,
// OutOfResources if it would have 4 GiB or more.
[[nodiscard]] base::Result<std::string> encodeGlb(const GlbModel& model);

}  // namespace terrane::formats
