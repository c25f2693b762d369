// Chooses the render scale during play, so that frames hold a rate. A pure state machine: frame times go in,
// a scale comes out. One thread at a time may use it.
#pragma once

#include <vector>

namespace terrane::render {

// Render scales that can be chosen, percent, ascending: RenderOptions::renderScale.
std::vector<int> governedScales(int most);

class ScaleGovernor {
  public:
    static constexpr double kWindowSeconds = 0.5;   // whose median frame counts
    static constexpr std::size_t kLeastFrames = 5;  // of a window, if it has fewer
    static constexpr int kLeastScale = 50;          // below, blocks are hard to tell apart
    static constexpr double kTooLong = 1.08;        // shares of the target
    static constexpr double kRoomToGrow = 0.95;
    static constexpr int kQuietWindows = 3;     // with room, before the scale grows
    static constexpr double kLeastGain = 0.95;  // of a frame, by which a smaller image must shorten it
    static constexpr int kWindowsInVain = 20;   // without another try after one that gained too little

    struct Frame {
        double seconds = 0;       // since the last frame
        double milliseconds = 0;  // that it took: without waiting for the screen
        bool isComplete = true;   // nothing is loading: loading takes time whatever the scale
    };

    // Returns the scale for the next frame, percent: at most `most`, the player's own.
    int scaleFor(int most) const;
    // Adds a frame drawn with scaleFor(most). `targetMilliseconds`: that it should take.
    void add(const Frame& frame, double targetMilliseconds, int most);
    void reset() { *this = {}; }

  private:
    void judge(double milliseconds, double target, int most);
    void set(int scale);

    int scale_ = 0;  // 0: not chosen yet, the player's own
    std::vector<double> milliseconds_;
    double seconds_ = 0;
    int quietWindows_ = 0, windowsInVain_ = 0;
    int before_ = 0;                 // scale before the last step down; 0: its gain is known
    double millisecondsBefore_ = 0;  // of a frame then
};

}  // namespace terrane::render
