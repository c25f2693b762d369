// Light at the corners of quads (Shading::Corners). The mesher merges faces whatever their light; here quads
// are split until light is linear on their two triangles, or nearly so. All functions are pure; any thread
// may call them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/light/chunk_light.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/shared/quad_light.h"
#include "terrane/shared/shape_face.h"

namespace terrane::render {

// The light of a chunk and of those around it, by y, then x; the chunk's own is in the middle. Null: unknown,
// which lights nothing.
using LightAround = std::array<const light::ChunkLight*, 9>;

// A mesh, and the light of each of its quads.
struct LitMesh {
    mesh::ChunkMesh mesh;
    std::vector<shared::QuadLight> light;
};

// Most that the light at a point of a quad may differ from what its corners give, in levels: more where it is
// bright, as one sees ratios.
constexpr float cornerLightTolerance(float level) {
    return 0.4f + 0.1f * level;
}

// Off: quads stay whole, where there is no room for more.
enum class Splitting : std::uint8_t { Off, On };

// Returns the mesh of a chunk with light at the corners, its quads split where needed. A corner of an upright
// or level face has the mean of the blocks around it in the layer in front of the face, without dark ones:
// opaque blocks, and air that nothing lights. Oblique faces have the light of their block. Without the
// chunk's own light all is in full daylight, as tiles of far land are. `shapeFaces`: mesh::shapeFaces().
LitMesh litAtCorners(const mesh::ChunkMesh& mesh, const LightAround& around,
                     std::span<const shared::ShapeFace> shapeFaces, Splitting splitting = Splitting::On);

}  // namespace terrane::render
