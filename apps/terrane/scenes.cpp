#include "apps/terrane/scenes.h"

#include <array>

namespace terrane::app {
namespace {

const std::array kScenes = {
    Scene{"ocean", {{-390, 200, 88}, 70, -4}, 0.40f},
    Scene{"desert", {{2100, 1300, 142}, 220, -14}, 0.36f},
    Scene{"landscape", {{1560, 700, 142}, 225, -6}, 0.70f},
    Scene{"cave", {{-276, 325, 88}, 90, -55}, 0.45f},
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

}  // namespace terrane::app
