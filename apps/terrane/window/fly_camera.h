// Moves a camera by keys and mouse. Pure bookkeeping: the window's input goes in, the camera comes out.
#pragma once

#include <span>

#include "terrane/gpu/input.h"
#include "terrane/render/camera.h"

namespace terrane::app {

struct FlyKeys {
    bool forward = false, back = false, left = false, right = false, up = false, down = false;
};

constexpr float kFlySpeed = 24.0f;          // blocks a second
constexpr float kMouseSensitivity = 0.15f;  // degrees a screen unit

void turn(render::Camera& camera, double right, double down);  // by screen units
void fly(render::Camera& camera, const FlyKeys& keys, float seconds);

}  // namespace terrane::app
