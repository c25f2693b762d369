// Runs `terrane play` in this process, in an OffscreenWindow, and drives it from a test: frame by frame, with
// keys, mouse, gamepad and named widgets. The program has a thread of its own, but only one of the two
// threads runs at a time: the program's during a frame, the test's between frames. So the test may look at
// everything.
#pragma once

#include <functional>
#include <initializer_list>
#include <semaphore>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "apps/terrane/window/game/game_state.h"
#include "apps/terrane/window/game/play_flow.h"
#include "terrane/base/image.h"
#include "tests/window/offscreen_window.h"

namespace terrane::app {

class Program {
  public:
    // Starts `terrane play` with these arguments; returns before its first frame, or when it has ended.
    // Without `hasTerminal` as if by its icon: an error is shown before the program ends.
    explicit Program(const std::vector<std::string>& arguments, bool hasTerminal = true);
    ~Program();  // ends it without saving, if it still runs
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    // Draws frames. They fail, as the functions below, by an exception if the program ends meanwhile.
    void frames(int count = 1);
    // Draws frames until the condition is true. `what`: for the message if that never happens.
    void until(std::string_view what, const std::function<bool()>& condition);
    void untilDrawn();  // the world in view is loaded and on the screen
    // Draws frames until the program ends; its result.
    base::Result<void> untilEnd();
    bool hasEnded() const { return hasEnded_; }
    base::Result<void> quit();  // by the menu

    void press(Key key, Modifiers with = {});  // and releases it within a frame; draws another one
    // Each of these takes a frame.
    void type(std::string_view text);
    void hold(Key key);
    void release(Key key);
    void tap(MouseButton button, Modifiers with = {});  // pressed and released within a frame
    void hold(MouseButton button);
    void release(MouseButton button);
    void turnWheel(double steps);
    void moveMouse(glm::dvec2 by);
    void setPad(const std::optional<Gamepad>& pad);

    // Widgets have the label that the program gives them, or the part of it before or after ##; `value` tells
    // equal labels apart.
    const Widget* find(std::string_view label, std::string_view value = {}) const;
    bool isShown(std::string_view label, std::string_view value = {}) const;
    const Widget& widget(std::string_view label, std::string_view value = {});  // waits for it
    std::string focused() const;  // the label of the focused widget
    // Scrolls to the widget if needed, and clicks in its middle, or elsewhere from 0 (left) to 1.
    void click(std::string_view label, std::string_view value = {}, double across = 0.5,
               MouseButton button = MouseButton::Left);

    // Called before each frame, such as to run a server; may be empty.
    std::function<void()> beforeFrame;

    OffscreenWindow& window() { return *window_; }
    // Calls it on the program's thread, whose OpenGL context it may use.
    void callThere(std::function<void()> call);
    base::Image worldImage();  // without the interface
    bool isPlaying() const { return host_->game != nullptr; }
    GameState& game();  // the world that is played
    game::Session& session() { return game().parts.session; }
    std::string blockAt(world::BlockPos pos);  // name

  private:
    void run(const std::vector<std::string>& arguments);
    void step();
    void moveTo(std::string_view label, std::string_view value, double across);

    std::shared_ptr<PlayHost> host_;
    OffscreenWindow* window_ = nullptr;  // owned by the program
    base::Result<void> result_;
    bool hasEnded_ = false;
    std::function<void()> call_;                 // instead of a frame
    std::binary_semaphore begins_{0}, ends_{0};  // a frame
    std::thread thread_;
};

}  // namespace terrane::app
