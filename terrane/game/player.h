// Moves a player, flying or on foot among blocks: input goes in, the pose comes out.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "terrane/world/character.h"
#include "terrane/world/pose.h"

namespace terrane::game {

enum class Movement : std::uint8_t {
    Walk,    // on foot
    Fly,     // not through blocks
    Noclip,  // flying through everything
};

struct MoveKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false;
    bool jump = false, run = false;
    bool autoJump = false;  // onto a block that is in the way, on foot
    glm::vec2 stick{0};     // of a gamepad: right, forward
};

constexpr float kNoclipSpeed = 16, kNoclipRunSpeed = 60;  // blocks a second

class Player {
  public:
    explicit Player(const world::Pose& pose, Movement movement) { placeAt(pose, movement); }

    const world::Pose& pose() const { return pose_; }
    Movement movement() const { return movement_; }
    const world::Character& character() const { return now_; }  // of a player on foot
    // Returns the bounding box of the player; none if it passes through blocks.
    std::optional<world::Aabb> body() const;

    void placeAt(const world::Pose& pose, Movement movement);
    void setMovement(Movement movement) { placeAt(pose_, movement); }
    void turn(double right, double down);  // degrees

    void move(const world::World& world, const world::BlockRegistry& blocks, const MoveKeys& keys,
              double seconds);

  private:
    void passThrough(world::Heights heights, const MoveKeys& keys, double seconds);
    void moveAmongBlocks(const world::World& world, const world::BlockRegistry& blocks, const MoveKeys& keys,
                         double seconds);

    world::Pose pose_;
    Movement movement_ = Movement::Walk;
    world::Character before_, now_;  // of the last two steps
    double untilStep_ = 0;           // seconds that are not yet a whole step
};

}  // namespace terrane::game
