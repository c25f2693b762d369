// Draws names of other players over their heads. Immediate mode: drawn each frame, on the thread that owns
// the world.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/terrane/window/overlay.h"

namespace terrane::app {

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

}  // namespace terrane::app
