// Draws names of other players over their heads. Immediate mode: drawn each frame, on the thread that owns
// the world.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/terrane/window/hud/overlay.h"
#include "terrane/game/session.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {

// Tests whether blocks hide a point from the camera, for overlays. On the thread that owns the world.
// Glass, liquids and plants hide nothing, nor does the block `own`.
bool isInSight(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& eye,
               const glm::dvec3& point, std::optional<world::BlockPos> own = std::nullopt);

constexpr double kNameDistance = 48;  // blocks at which names disappear
constexpr std::size_t kMostNames = 64;

struct NameTag {
    std::string name;
    glm::dvec3 eyes{0};  // as of world::Figure
};

struct NamesView {
    const world::World& world;
    const world::BlockRegistry& blocks;
};

struct ShownName {
    const NameTag* tag = nullptr;
    glm::vec2 at{0};  // middle of the lower edge, in Dear ImGui's units
    float size = 1;   // share of the font's size
    float alpha = 1;
};

// The names to draw: in front of the camera, near, and with the head in sight. The nearest kMostNames,
// farthest first, so that near names are drawn over far ones. The result points into `names`.
std::vector<ShownName> shownNames(const Screen& screen, const render::Camera& camera,
                                  std::span<const NameTag> names, const NamesView& view);

void drawNames(const Screen& screen, const render::Camera& camera, std::span<const NameTag> names,
               const NamesView& view);

// Draws the text of signs near the camera over the image, on the planes of their boards. Immediate mode.
constexpr double kSignDistance = 24;  // blocks at which text disappears

// The nearest signs around a point, at most 64. Visits the block entity data of the chunks there.
std::vector<world::BlockPos> signsNear(const game::Session& session, const glm::dvec3& point);

// Draws the letters that no block hides, of signs that face the camera; skips blocks that are no longer
// signs. Glass, liquids and plants hide no letters.
void drawSigns(const Screen& screen, const render::Camera& camera, const game::Session& session,
               const std::vector<world::BlockPos>& signs);

}  // namespace terrane::app
