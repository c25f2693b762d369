// The world behind the title: a slow flight in a circle through the last played world, which is opened
// read-only, or through a demo world in memory. Used on the thread of the OpenGL context.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "apps/terrane/window/game/world_on_screen.h"
#include "apps/terrane/window/settings/play_settings.h"

namespace terrane::app {

// The pose after `seconds` of the flight: on a circle around `center`, at its height, looking ahead and a
// little inward and down.
world::Pose flightPose(const glm::dvec3& center, double seconds);

class TitleBackground {
  public:
    // `save`: a world's file; empty, or if it cannot be opened: the demo world.
    [[nodiscard]] static base::Result<TitleBackground> open(const PlayOptions& options,
                                                            const ScreenOptions& screen,
                                                            const std::filesystem::path& save);

    // Draws into the window; a plain color until shaders are compiled. `isStill` stops the flight.
    base::Result<void> draw(glm::ivec2 windowSize, double seconds, bool isStill);
    bool hasImage() const { return world_->renderer().size().x > 0; }
    // The open save, which others cannot write meanwhile; empty for the demo world.
    const std::filesystem::path& save() const { return save_; }

  private:
    TitleBackground(std::unique_ptr<WorldOnScreen> world, std::filesystem::path save)
        : world_(std::move(world)), save_(std::move(save)) {}
    void begin(const PlayOptions& options, const ScreenOptions& screen);
    base::Result<bool> configure(glm::ivec2 size);

    std::unique_ptr<WorldOnScreen> world_;
    std::filesystem::path save_;
    render::RenderOptions render_;
    int viewDistance_ = 0, pixelsShare_ = 1;  // window pixels per image pixel, per side
    glm::dvec3 center_{0};
    double flightSeconds_ = 0, seconds_ = 0;
};

}  // namespace terrane::app
