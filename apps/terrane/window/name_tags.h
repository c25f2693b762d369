// The names of other players over their heads. Immediate mode: drawn each frame, on the thread that owns the
// world.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/terrane/window/overlay.h"

namespace terrane::app {

constexpr double kNameDistance = 48;  // blocks from which a name is seen
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

// Those before the camera and near enough whose head no wall hides, at most kMostNames; the nearest is last,
// to be drawn over the others. They point into `names`.
std::vector<ShownName> shownNames(const Screen& screen, const render::Camera& camera,
                                  std::span<const NameTag> names, const NamesView& view);

void drawNames(const Screen& screen, const render::Camera& camera, std::span<const NameTag> names,
               const NamesView& view);

}  // namespace terrane::app
