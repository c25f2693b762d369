// Building beyond single blocks: the selection tool, and the text of signs. The game loop passes it keys,
// buttons and frames.
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
    // Structures are files in a subfolder of `dataFolder`.
    explicit BuildingTools(const std::filesystem::path& dataFolder) : selection_(dataFolder / "structures") {}

    // The player types or chooses something: the cursor is free, and all keys go to onKey().
    bool isAsking() const { return sign_ || selection_.isAsking(); }
    bool isSelecting() const { return selection_.isActive(); }
    // True if the tools handled the key or button.
    bool onKey(Key key, const BuildView& view);
    bool onButton(MouseButton button, const BuildView& view) { return selection_.onButton(button, view); }
    // Opens the text of a block for editing; false if the block holds no text.
    bool openSign(world::BlockPos pos, const BuildView& view);
    // Closes one open thing per call; false if nothing is open.
    bool close();

    // `seconds`: since the start.
    void draw(const Screen& screen, const render::Camera& camera, const BuildView& view, double seconds);
    std::optional<std::string> takeMessage();

  private:
    void drawSign(const Screen& screen, const BuildView& view);

    SelectionTool selection_;
    std::optional<SignDialog> sign_;
    base::TimedValue<std::vector<world::BlockPos>> signs_{0.25};  // near the camera
    std::optional<std::string> message_;
};

}  // namespace terrane::app
