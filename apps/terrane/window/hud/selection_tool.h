// The tool that builds with boxes of blocks: handles keys and clicks, sends commands to the session, returns
// messages, and draws its panel and outlines (docs/building.md).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/input.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/selection.h"
#include "terrane/game/session.h"
#include "terrane/world/character.h"

namespace terrane::app {

// The view of the game that building tools get: the session, and the player's pose, block and held keys.
struct BuildView {
    game::Session& session;
    const Texts& tr;
    world::Pose pose;
    std::optional<world::Aabb> body;  // none while the player flies through blocks
    world::BlockId hand = world::kAir;
    bool shift = false, control = false;  // keys that are held
};

enum class ToolAction : std::uint8_t { Fill, Replace, Clear, Shape, Copy, Paste, Turn, Mirror, Save, Open };

std::string withCommas(std::int64_t number);  // 12,345

// The block at the player's feet with Shift; else the targeted block, or the cell before it if `beforeBlock`;
// else a cell in the air ahead.
world::BlockPos pointedAt(const BuildView& view, bool beforeBlock);

// The result of a command for the player: "changed 12 blocks", or why none changed.
std::string outcomeText(std::string_view verb, const game::BuildOutcome& outcome);

class SelectionTool {
  public:
    // `folder` has the structure files; created with the first one.
    explicit SelectionTool(std::filesystem::path folder) : folder_(std::move(folder)) {}

    bool isActive() const { return isActive_; }
    // The player types or chooses a name: the cursor is free, and all keys go to onKey().
    bool isAsking() const { return asks_ != Asks::Nothing; }
    // True if the tool handled the key or button.
    bool onKey(Key key, const BuildView& view);
    bool onButton(MouseButton button, const BuildView& view);
    // With Control the wheel moves the top of the box, with Shift too its bottom. `steps`: up if positive.
    bool onWheel(int steps, const BuildView& view);
    // Closes the question, ends pasting or deactivates the tool, one per call; false if there is nothing to
    // end.
    bool close();

    void drawOutlines(const Screen& screen, const render::Camera& camera, const BuildView& view) const;
    void drawPanel(OverlayLayout& layout, const BuildView& view);
    std::optional<std::string> takeMessage() { return std::exchange(message_, std::nullopt); }

  private:
    enum class Asks : std::uint8_t { Nothing, Name, File };

    void act(ToolAction action, const BuildView& view);
    void fill(const BuildView& view, world::BlockId id, std::optional<world::BlockId> replaced);
    void replace(const BuildView& view);
    void copy(const BuildView& view);
    void beginPaste();
    void place(const BuildView& view);
    void askName();
    void askFile();
    void saveAs(const std::string& name);
    void open(const std::string& name, const world::BlockRegistry& blocks);
    void onKeyWhileAsking(Key key);
    void answer(const BuildView& view);
    void drawContents(const BuildView& view);
    void drawName(const Texts& tr);
    void drawFiles(const Texts& tr);

    std::filesystem::path folder_;
    game::Selection selection_;
    std::optional<ToolAction> pressed_;  // button of the panel
    bool isActive_ = false;
    Asks asks_ = Asks::Nothing;
    bool takesFocus_ = false, isAnswered_ = false;
    std::array<char, 101> name_{};  // of a file, as typed
    std::vector<std::string> files_;
    std::size_t file_ = 0;  // chosen index
    std::optional<std::string> message_;
};

}  // namespace terrane::app
