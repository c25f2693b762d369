#include "apps/terrane/scenes.h"

#include <array>

namespace terrane::app {
namespace {

const std::array kScenes = {
    Scene{"ocean", {{-250, 260, 92}, 135, -6}, 0.40f},
    Scene{"desert", {{240, 40, 104}, 20, -10}, 0.34f},
    Scene{"landscape", {{-60, -120, 112}, 90, -14}, 0.38f},
    Scene{"cave", {{0, 0, 70}, 0, -60}, 0.5f},
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
