// The person in the world: how keys and mouse move the camera. Pure bookkeeping: input goes in, the camera
// comes out.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "terrane/render/camera.h"
#include "terrane/world/character.h"

namespace terrane::app {

enum class Movement : std::uint8_t {
    Fast,     // through everything
    Medium,   // the same, slower
    Walls,    // at walking speed, flying, but not through blocks
    Gravity,  // on foot
};

struct MoveKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false;
    bool jump = false, run = false;
    glm::vec2 stick{0};  // of a gamepad: right, forward
};

constexpr float kFastSpeed = 60, kMediumSpeed = 16;  // blocks a second

class Player {
  public:
    explicit Player(const render::Camera& camera, Movement movement) { placeAt(camera, movement); }

    const render::Camera& camera() const { return camera_; }
    Movement movement() const { return movement_; }
    // Where the person cannot pass through blocks: what it takes up.
    std::optional<world::Aabb> body() const;

    void placeAt(const render::Camera& camera, Movement movement);
    void setMovement(Movement movement) { placeAt(camera_, movement); }
    void setFieldOfView(float degrees) { camera_.fieldOfView = degrees; }
    void turn(double right, double down);  // degrees

    void move(const world::World& world, const world::BlockRegistry& blocks, const MoveKeys& keys,
              double seconds);

  private:
    void fly(const MoveKeys& keys, double seconds, float speed);
    void walk(const world::World& world, const world::BlockRegistry& blocks, const MoveKeys& keys,
              double seconds);

    render::Camera camera_;
    Movement movement_ = Movement::Gravity;
    world::Character before_, now_;  // of the last two steps
    double untilStep_ = 0;           // seconds that made no step yet
};

}  // namespace terrane::app
