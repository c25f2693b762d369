// The exposure of an eye that adapts to the light it sees: caves become readable, moonlit land has shapes,
// and stone stays stone under colored lamps. It is computed from the blocks and their light levels, not from
// the image. So it costs the same with every preset, is known before the frame, and is equal at equal places.
// It is used on the thread that owns the session.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "terrane/game/session.h"
#include "terrane/render/frame/frame_uniforms.h"

namespace terrane::view {

// Returns "inside NAME" or "at a face of NAME" of a camera that sees through the block there, since faces are
// not drawn from behind and near ones are cut open; nothing of one in the open.
std::optional<std::string> blockAtCamera(const game::Session& session, const render::Camera& camera);

// Light on surfaces in view, and of those that glow, along rays that fill the image.
struct SeenLight {
    float luminance = 1;  // as in world::Environment; the mean of logarithms
    glm::vec3 color{1};   // of luminance 1; sun, moon and sky count as white
};
SeenLight seenLight(const game::Session& session, const render::FrameInput& input, float aspect);

// Returns the exposure by color after the eye has adapted, 1 by day. It makes up for a part of the darkness,
// so nights stay darker than days, and for a part of the color of lamps (J. von Kries, 1902: each kind of
// cones adapts for itself; here the channels do).
glm::vec3 exposureFor(const SeenLight& light);

// An eye that takes time: some 0.4 s to daylight, 1.5 s to darkness.
class Eye {
  public:
    // Returns the exposure. Call it once before each frame, `seconds` after the frame before. The first frame
    // is adapted.
    glm::vec3 look(const game::Session& session, const render::FrameInput& input, float aspect,
                   double seconds);

  private:
    glm::vec3 exposure_{0}, target_{1};  // exposure_ 0: nothing was seen yet
    double sinceLook_ = 0;
};

}  // namespace terrane::view
