// A button that acts once when it is pressed, and again and again while it is held.
#pragma once

namespace terrane::app {

class HeldButton {
  public:
    static constexpr double kFirstPause = 0.3, kPause = 0.15;  // seconds

    void press() {
        isDown_ = true;
        wait_ = 0;
        pause_ = kFirstPause;
    }
    void release() { isDown_ = false; }
    bool isDown() const { return isDown_; }

    // Whether it acts in a frame of this length; at most once a frame.
    bool acts(double seconds) {
        if (!isDown_) return false;
        wait_ -= seconds;
        if (wait_ > 0) return false;
        wait_ = pause_;
        pause_ = kPause;
        return true;
    }

  private:
    bool isDown_ = false;
    double wait_ = 0, pause_ = kFirstPause;
};

}  // namespace terrane::app
