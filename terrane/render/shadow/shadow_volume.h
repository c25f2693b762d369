// Volume of possible shadow casters for the part of the world near the camera: everything toward the light
// from there. For statistics and the debug top view; shadow_casters.h selects what is drawn. All functions
// are pure; any thread may call them.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrane/render/frame/camera.h"
#include "terrane/render/quads/quad_store.h"

namespace terrane::render {

// Blocks from the camera: the reach of the nearest cascade, and of the thesis's shadow map.
constexpr float kShadowReach = 50;

// A rectangle across the light, and along its direction everything from `farthest` on toward it.
struct ShadowVolume {
    glm::mat3 toLight;  // x and y across the light, z toward it
    glm::vec2 min, max;
    float farthest;
};

// Returns the volume of the view within `reach` blocks. `lightDirection` points to the light.
ShadowVolume shadowVolume(const ViewMatrices& view, glm::vec3 lightDirection, float reach);
// Returns false only if no point of the box is in the volume. Coordinates as in ViewMatrices.
bool mayBeInVolume(const ShadowVolume& volume, glm::vec3 boxMin, glm::vec3 boxMax);

// Returns the corners of the space that the nearest cascade may cover, in the world, as far along the light
// as across. Bits of a corner's number: 1 for the map's x, 2 for y, 4 for toward the light.
std::array<glm::dvec3, 8> nearShadowBox(const Camera& camera, glm::vec3 lightDirection);

// Returns the number of triangles that one shadow map of the nearest kShadowReach blocks would draw of these
// chunks: mesh sections in the volume, without blended quads and without the face directions that face away
// from the light.
std::size_t countShadowTriangles(const QuadStore& quads, const Camera& camera, const ViewMatrices& view,
                                 glm::vec3 lightDirection);

}  // namespace terrane::render
