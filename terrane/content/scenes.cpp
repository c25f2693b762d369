#include "terrane/content/scenes.h"

#include <array>

namespace terrane::content {
namespace {

const std::array kScenes = {
    Scene{"ocean", {{992, 1092, 89}, 163, -3}, 0.36f},
    Scene{"desert", {{1318, -790, 112}, 318, -6}, 0.36f},
    Scene{"landscape", {{-1048, -108, 122}, 136, -6}, 0.62f},
    Scene{"cave", {{-109, 280, 88}, 90, -58}, 0.50f},
};

}  // namespace

std::span<const Scene> scenes() {
    return kScenes;
}

const Scene* findScene(std::string_view name) {
    for (const Scene& scene : kScenes) {
        if (scene.name == name) return &scene;
    }
    return nullptr;
}

}  // namespace terrane::content
