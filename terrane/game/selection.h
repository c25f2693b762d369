// What a player builds with boxes of blocks: two corners, and a structure that is copied, turned and pasted.
// It knows no world, window or keys; the window's tool (apps/terrane/window/selection_tool.h) drives it.
// Plain value.
#pragma once

#include <memory>
#include <optional>

#include "terrane/world/structure.h"

namespace terrane::game {

class Selection {
  public:
    void setFirst(world::BlockPos corner) { first_ = corner; }
    void setSecond(world::BlockPos corner) { second_ = corner; }
    void clear() { first_ = second_ = std::nullopt; }
    const std::optional<world::BlockPos>& first() const { return first_; }
    const std::optional<world::BlockPos>& second() const { return second_; }
    // From corner to corner, or of the only one there is; none without.
    std::optional<world::BlockBox> box() const;

    // Null where nothing was copied or read.
    const std::shared_ptr<const world::Structure>& clipboard() const { return clipboard_; }
    void setClipboard(world::Structure structure);
    // A quarter against the clock seen from above. Nothing happens without a clipboard.
    void turn(const world::BlockRegistry& blocks);
    // What is left of who looks along `yaw` (degrees) is right afterwards.
    void mirror(const world::BlockRegistry& blocks, float yaw);

    // Between beginPaste() and endPaste() the clipboard follows the crosshair. False without a clipboard.
    bool beginPaste() { return isPasting_ = clipboard_ != nullptr; }
    void endPaste() { isPasting_ = false; }
    bool isPasting() const { return isPasting_; }
    // Where the clipboard goes whose bottom layer has its middle at a block; moved into the world's height as
    // far as it fits. None without a clipboard.
    std::optional<world::BlockPos> pasteCorner(world::BlockPos middle) const;

  private:
    std::optional<world::BlockPos> first_, second_;
    std::shared_ptr<const world::Structure> clipboard_;
    bool isPasting_ = false;
};

// The mirror that swaps left and right of who looks along `yaw`: 90 looks along +y.
world::MirrorAxis sidewaysAxis(float yaw);

}  // namespace terrane::game
