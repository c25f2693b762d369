#include "apps/terrane/window/screen_projection.h"

#include <glm/common.hpp>

namespace terrane::app {

ScreenProjection::ScreenProjection(glm::vec2 size, const render::Camera& camera) : size_(size) {
    const world::ChunkPos chunk = render::cameraChunk(camera);
    corner_ = {16.0 * chunk.x, 16.0 * chunk.y, 0};
    viewProjection_ = render::viewMatrices(camera, size.x / size.y).viewProjection;
}

glm::vec4 ScreenProjection::clip(const glm::dvec3& point) const {
    return viewProjection_ * glm::vec4(glm::vec3(point - corner_), 1.0f);
}

glm::vec2 ScreenProjection::onScreen(const glm::vec4& clip) const {
    return {(clip.x / clip.w * 0.5f + 0.5f) * size_.x, (0.5f - clip.y / clip.w * 0.5f) * size_.y};
}

std::optional<glm::vec2> ScreenProjection::at(const glm::dvec3& point) const {
    const glm::vec4 place = clip(point);
    if (place.w <= render::kNearPlane) return std::nullopt;
    return onScreen(place);
}

std::optional<std::pair<glm::vec2, glm::vec2>> ScreenProjection::line(const glm::dvec3& from,
                                                                      const glm::dvec3& to) const {
    constexpr float kNear = 2 * render::kNearPlane;
    glm::vec4 a = clip(from), b = clip(to);
    if (a.w < kNear && b.w < kNear) return std::nullopt;
    if (a.w < kNear) a = glm::mix(a, b, (kNear - a.w) / (b.w - a.w));
    if (b.w < kNear) b = glm::mix(b, a, (kNear - b.w) / (a.w - b.w));
    return std::pair(onScreen(a), onScreen(b));
}

}  // namespace terrane::app
