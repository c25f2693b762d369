// All that a player builds with beside single blocks: the selection tool, and the text of signs. The game's
// loop gives it keys, buttons and each frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/window/selection_tool.h"
#include "apps/terrane/window/sign_dialog.h"
#include "terrane/base/timed_value.h"

namespace terrane::app {

class BuildingTools {
  public:
    // `dataFolder` has a folder for structures.
    explicit BuildingTools(const std::filesystem::path& dataFolder) : selection_(dataFolder / "structures") {}

    // Something is typed or chosen: the cursor is free, and all keys go to onKey().
    bool isAsking() const { return sign_ || selection_.isAsking(); }
    bool isSelecting() const { return selection_.isActive(); }
    // True where a key or a button was for the tools.
    bool onKey(Key key, const BuildView& view);
    bool onButton(MouseButton button, const BuildView& view) { return selection_.onButton(button, view); }
    // Edits the text of the block. False where it holds none.
    bool openSign(world::BlockPos pos, const BuildView& view);
    // Closes what is open, one thing a call; false where there is nothing.
    bool close();

    // `seconds`: since the start.
    void draw(const Screen& screen, const render::Camera& camera, const BuildView& view, double seconds);
    std::optional<std::string> takeMessage();

  private:
    void drawSign(const Screen& screen, const BuildView& view);

    SelectionTool selection_;
    std::optional<SignDialog> sign_;
    base::TimedValue<std::vector<world::BlockPos>> signs_{0.25};  // those near the camera
    std::optional<std::string> message_;
};

}  // namespace terrane::app
