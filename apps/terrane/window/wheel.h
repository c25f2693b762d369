// Steps of the mouse wheel. Touchpads and smooth wheels turn by parts of a step, or sideways.
#pragma once

#include <cmath>

namespace terrane::app {

class Wheel {
  public:
    // `y`: of an InputEvent of the wheel. Returns the whole steps since the last ones, away from the player;
    // a turn in the other direction begins anew.
    int turn(double y) {
        part_ = part_ * y < 0 ? y : part_ + y;
        const double steps = std::trunc(part_);
        part_ -= steps;
        return static_cast<int>(steps);
    }

  private:
    double part_ = 0;  // of a step
};

}  // namespace terrane::app
