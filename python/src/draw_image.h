// Draws one image of an opened world without a window. Makes an OpenGL context of its own for each image, on
// a thread of its own, so that contexts of the caller stay as they are. Any thread, one image at a time each.
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
    int horizon = 0;            // chunks that land goes on for, 0: not beyond the view distance
    std::string preset = "high";
};

struct DrawnWorld {
    std::shared_ptr<volume::OpenedWorld> opened;
    pack::Content content;  // that it was opened with
    unsigned threads = 1;
};

// BadInput where a value is out of range, Failed where the machine cannot draw.
[[nodiscard]] base::Result<base::Image> drawImage(const DrawnWorld& world, const ImageRequest& request);

}  // namespace terrane::python
