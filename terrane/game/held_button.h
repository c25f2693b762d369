// A button that acts when it is pressed and repeats while it is held.
#pragma once

namespace terrane::game {

class HeldButton {
  public:
    static constexpr double kFirstPause = 0.3, kPause = 0.15;  // seconds

    void press() { isDown_ = isNew_ = true; }
    // A button that is pressed and released within a frame still acts.
    void release() { isDown_ = false; }
    void cancel() { isDown_ = isNew_ = false; }
    bool isDown() const { return isDown_; }

    // Whether it acts in a frame of this length; at most once a frame.
    bool acts(double seconds) {
        if (isNew_) {
            isNew_ = false;
            wait_ = kFirstPause;
            return true;
        }
        if (!isDown_) return false;
        wait_ -= seconds;
        if (wait_ > 0) return false;
        wait_ = kPause;
        return true;
    }

  private:
    bool isDown_ = false, isNew_ = false;
    double wait_ = 0;  // seconds until it acts again
};

}  // namespace terrane::game
