// The player's arm with the block in the hand, at the right edge of the image. It sways while walking and
// swings for actions. Immediate mode: drawn each frame.
#pragma once

#include <glm/vec3.hpp>

#include "apps/terrane/window/hud/overlay.h"
#include "terrane/game/session.h"

namespace terrane::app {

// The light on the block in the player's hand.
// Display color, 0…1, of daylight and lamps in the block of the eye; a simplified form of the world's
// shading.
glm::vec3 lightOnHand(const game::Session& session, const glm::dvec3& eyes);

class HandView {
  public:
    void swing() { swingSeconds_ = kSwingSeconds; }
    // `walked`: blocks over the ground since the last frame. If `sways` is false the arm keeps still.
    void advance(double seconds, double walked, bool sways);
    // `image`: OpenGL texture of the block, 0: none. `light`: on the arm, 0…1 per color.
    void draw(const Screen& screen, unsigned image, const glm::vec3& light) const;

  private:
    static constexpr double kSwingSeconds = 0.25;

    double swingSeconds_ = 0;  // that are left
    double stride_ = 0;        // radians
    double swayShare_ = 0;     // 0 at rest … 1 while walking
};

}  // namespace terrane::app
