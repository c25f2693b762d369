#include "apps/terrane/window/hud/particle_view.h"

#include <imgui.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "apps/terrane/window/hud/overlay.h"

namespace terrane::app {

void drawParticles(const Screen& screen, const render::Camera& camera, const view::BlockParticles& particles,
                   const world::TopColors& colors, const glm::vec3& light) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float perBlock = screen.height / (2 * std::tan(glm::radians(camera.fieldOfView) / 2));
    const ScreenProjection projection({screen.width, screen.height}, camera);
    for (const view::Particle& p : particles.particles()) {
        const auto at = projection.at(p.position);
        const double distance = glm::distance(p.position, camera.position);
        if (!at || distance < 0.3 || p.block >= colors.size()) continue;
        const float half = p.side / 2 * perBlock / static_cast<float>(distance);
        const float shade = 0.7f + 0.3f * static_cast<float>(p.shade) / 255;
        const glm::vec3 color = glm::clamp(colors[p.block].mean * light * shade, 0.0f, 255.0f);
        draw.AddRectFilled(
            {at->x - half, at->y - half}, {at->x + half, at->y + half},
            IM_COL32(static_cast<int>(color.x), static_cast<int>(color.y), static_cast<int>(color.z), 255));
    }
}

}  // namespace terrane::app
