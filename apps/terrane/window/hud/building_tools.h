// Building beyond single blocks: the selection tool, and the text of signs. The game loop passes it keys,
// buttons and frames.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/hud/selection_tool.h"
#include "apps/terrane/window/input.h"
#include "apps/terrane/window/text.h"
#include "terrane/base/timing.h"
#include "terrane/world/blocks/sign.h"

namespace terrane::app {

// The dialog that edits the lines of a sign. Immediate mode: draws, and returns the choice.
class SignDialog {
  public:
    enum class Choice : std::uint8_t { Done, Cancel };

    SignDialog(world::BlockPos sign, const world::SignText& text);

    world::BlockPos sign() const { return sign_; }
    world::SignText text() const;
    // Handles Enter, Escape, and up and down between lines. The choice comes from draw(), after text typed in
    // the same frame.
    void onKey(Key key);
    std::optional<Choice> draw(const Screen& screen, const Texts& tr);

  private:
    // The bytes of a line and a terminator.
    using Line = std::array<char, world::kSignColumns * 4 + 1>;

    world::BlockPos sign_;
    std::array<Line, world::kSignLines> lines_{};
    std::size_t line_ = 0;  // with the focus
    bool takesFocus_ = true;
    std::optional<Choice> choice_;
};

class BuildingTools {
  public:
    // Structures are files in a subfolder of `dataFolder`.
    explicit BuildingTools(const std::filesystem::path& dataFolder) : selection_(dataFolder / "structures") {}

    // The player types or chooses something: the cursor is free, and all keys go to onKey().
    bool isAsking() const { return sign_ || selection_.isAsking(); }
    bool isSelecting() const { return selection_.isActive(); }
    // True if the tools handled the key or button.
    bool onKey(Key key, const BuildView& view);
    bool onButton(MouseButton button, const BuildView& view) { return selection_.onButton(button, view); }
    bool onWheel(int steps, const BuildView& view) { return selection_.onWheel(steps, view); }
    // Opens the text of a block for editing; false if the block holds no text.
    bool openSign(world::BlockPos pos, const BuildView& view);
    // Closes one open thing per call; false if nothing is open.
    bool close();

    // What is in the world: signs, and outlines of boxes. `seconds`: since the start.
    void drawInWorld(const Screen& screen, const render::Camera& camera, const BuildView& view,
                     double seconds);
    void drawPanels(OverlayLayout& layout, const BuildView& view);
    std::optional<std::string> takeMessage();

  private:
    void drawSign(const Screen& screen, const BuildView& view);

    SelectionTool selection_;
    std::optional<SignDialog> sign_;
    base::TimedValue<std::vector<world::BlockPos>> signs_{0.25};  // near the camera
    std::optional<std::string> message_;
};

}  // namespace terrane::app
