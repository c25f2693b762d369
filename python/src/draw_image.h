// Draws one image of an opened world without a window. Each image has its own OpenGL context on its own
// thread, so contexts of the caller stay unchanged. Any thread.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/pack/content.h"
#include "terrane/volume/opened_world.h"
#include "terrane/world/pose.h"

namespace terrane::python {

constexpr int kMaxImageSide = 8192;                       // pixels
constexpr int kMaxViewDistance = 64, kMaxHorizon = 4096;  // chunks

struct ImageRequest {
    world::Pose pose;
    glm::ivec2 size{640, 360};  // pixels: width, height
    float fieldOfView = 70;     // degrees, vertical
    float timeDay = 0.5f;       // 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk
    int viewDistance = 16;      // chunks in full detail
    int horizon = 0;            // chunks up to which coarse terrain is drawn; 0: none
    std::string preset = "high";
};

struct DrawnWorld {
    std::shared_ptr<volume::OpenedWorld> opened;
    pack::Content content;  // that it was opened with
    unsigned threads = 1;
};

// BadInput if a value is out of range, Failed if the machine cannot draw.
[[nodiscard]] base::Result<base::Image> drawImage(const DrawnWorld& world, const ImageRequest& request);

}  // namespace terrane::python
