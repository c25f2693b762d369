// Projects points of the world to the screen, for overlays. Plain value.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

#include "terrane/render/camera.h"

namespace terrane::app {

class ScreenProjection {
  public:
    // `size` in Dear ImGui's units.
    ScreenProjection(glm::vec2 size, const render::Camera& camera);

    // None behind the camera.
    std::optional<glm::vec2> at(const glm::dvec3& point) const;
    // The part of a line in front of the camera.
    std::optional<std::pair<glm::vec2, glm::vec2>> line(const glm::dvec3& from, const glm::dvec3& to) const;

  private:
    glm::vec4 clip(const glm::dvec3& point) const;
    glm::vec2 onScreen(const glm::vec4& clip) const;

    glm::vec2 size_;
    glm::dvec3 corner_;  // of the camera's chunk
    glm::mat4 viewProjection_;
};

}  // namespace terrane::app
