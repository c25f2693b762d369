// A player's selection of blocks: two corners, and a clipboard that is turned and pasted. Independent of
// world, window and keys; apps/terrane/window/hud/selection_tool.h drives it. It is a plain value.
#pragma once

#include <memory>
#include <optional>

#include "terrane/game/fill_shape.h"
#include "terrane/world/changes/structure.h"

namespace terrane::game {

class Selection {
  public:
    void setFirst(world::BlockPos corner) { first_ = corner; }
    void setSecond(world::BlockPos corner) { second_ = corner; }
    // Returns the box from corner to corner, or of the only corner; none without corners.
    std::optional<world::BlockBox> box() const;
    // Moves the top or the bottom of the box by blocks up (positive) or down. It passes neither the other end
    // nor the height of the world. Returns whether the box changed.
    enum class End : std::uint8_t { Top, Bottom };
    bool moveEnd(End end, int blocks, world::Heights heights);

    // The shape that fills take in the box. A line goes from the first corner to the second.
    void setShape(ShapeKind shape) { shape_ = shape; }
    ShapeKind shapeKind() const { return shape_; }
    FillShape shape() const;

    // Returns the clipboard; null if nothing was copied or read.
    const std::shared_ptr<const world::Structure>& clipboard() const { return clipboard_; }
    void setClipboard(world::Structure structure);
    // Turns the clipboard by a quarter counterclockwise, seen from above. Does nothing without a clipboard.
    void turn(const world::BlockRegistry& blocks);
    // Swaps left and right of the clipboard, as seen along `yaw` (degrees).
    void mirror(const world::BlockRegistry& blocks, float yaw);

    // Begins to paste: until endPaste() the clipboard follows the crosshair. Returns false without a
    // clipboard.
    bool beginPaste() { return isPasting_ = clipboard_ != nullptr; }
    void endPaste() { isPasting_ = false; }
    bool isPasting() const { return isPasting_; }
    // Returns the lowest corner of a clipboard with the middle of its bottom layer at a block; moved into the
    // height of the world as far as it fits. Returns nothing without a clipboard.
    std::optional<world::BlockPos> pasteCorner(world::BlockPos middle, world::Heights heights) const;

  private:
    std::optional<world::BlockPos> first_, second_;
    ShapeKind shape_ = ShapeKind::Solid;
    std::shared_ptr<const world::Structure> clipboard_;
    bool isPasting_ = false;
};

// Returns the axis that swaps left and right as seen along `yaw`: 90 looks along +y.
world::MirrorAxis sidewaysAxis(float yaw);

}  // namespace terrane::game
