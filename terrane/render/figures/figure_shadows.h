// Tracks the tiles of the nearest shadow map that the shadows of figures fall on. Figures move in each frame,
// but the map's tiles are drawn rarely (shadow_clipmap.h). So figures are drawn into a copy of the map, of
// which only tiles with figures, and tiles that the map drew again, are copied again. It uses no OpenGL; one
// thread uses it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrane/render/shadow/shadow_clipmap.h"

namespace terrane::render {

// Blocks from the camera. The nearest map reaches about 50 blocks; the difference is for arms and legs.
constexpr double kFigureShadowReach = 46;

struct FigureShadowPlan {
    std::vector<glm::ivec2> copies;  // slots of tiles to copy from the map
    std::vector<ShadowTiles> draws;  // then all figures are drawn into these; `layer` is the map's
};

class FigureShadows {
  public:
    // Plans a frame for figures whose feet are at these places, within kFigureShadowReach. An empty plan
    // means that no tile has a figure, and the map itself is used. Otherwise the copy is up to date
    // afterward.
    FigureShadowPlan plan(const NearestShadowMap& map, std::span<const glm::dvec3> feet);
    // Marks the copy as empty.
    void invalidate() { copied_ = {}; }

  private:
    struct Copied {
        int layer = -1;
        std::uint64_t drawn = 0;
        bool hasFigures = false;
    };
    std::array<Copied, kShadowSlots> copied_;
};

}  // namespace terrane::render
