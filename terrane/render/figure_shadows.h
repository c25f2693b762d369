// Which tiles of the nearest shadow map the shadows of figures fall on. Figures move in each frame, the map's
// tiles stay (shadow_clipmap.h): so figures are drawn into a copy of the map, of which only tiles with
// figures, and those that the map drew anew, are copied again. Plain bookkeeping without OpenGL; one thread.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrane/render/shadow_clipmap.h"

namespace terrane::render {

// From the camera. The nearest map reaches some 50 blocks; what is left is for arms and legs.
constexpr double kFigureShadowReach = 46;

struct FigureShadowPlan {
    std::vector<glm::ivec2> copies;  // slots of tiles to copy from the map
    std::vector<ShadowTiles> draws;  // then all figures are drawn into these; `layer` is the map's
};

class FigureShadows {
  public:
    // For figures whose feet are at these places, within kFigureShadowReach. Nothing is to be done, and the
    // map itself to be used, where no tile has a figure. Otherwise the copy is up to date afterward.
    FigureShadowPlan plan(const NearestShadowMap& map, std::span<const glm::dvec3> feet);
    // The copy holds nothing.
    void forget() { copied_ = {}; }

  private:
    struct Copied {
        int layer = -1;
        std::uint64_t drawn = 0;
        bool hasFigures = false;
    };
    std::array<Copied, kShadowSlots> copied_;
};

}  // namespace terrane::render
