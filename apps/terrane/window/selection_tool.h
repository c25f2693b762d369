// The tool that builds with boxes of blocks: keys and clicks in, commands to the session and messages out.
// Its panel and outlines are drawn over the image. docs/building.md tells how it is used.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/terrane/window/build_view.h"
#include "apps/terrane/window/input.h"
#include "apps/terrane/window/overlay.h"
#include "terrane/game/selection.h"

namespace terrane::app {

enum class ToolAction : std::uint8_t { Fill, Replace, Clear, Copy, Paste, Turn, Mirror, Save, Open };

std::string withCommas(std::int64_t number);  // 12,345

// With Shift where the player stands; else the block that is looked at, or the free place before it; else a
// place in the air.
world::BlockPos pointedAt(const BuildView& view, bool beforeBlock);

// What became of a command, for the player: "changed 12 blocks", or why nothing did.
std::string outcomeText(std::string_view verb, const game::BuildOutcome& outcome);

class SelectionTool {
  public:
    // `folder`: of the files; made with the first one.
    explicit SelectionTool(std::filesystem::path folder) : folder_(std::move(folder)) {}

    bool isActive() const { return isActive_; }
    // A name is typed or chosen: all keys are for that, and the cursor is free.
    bool isAsking() const { return asks_ != Asks::Nothing; }
    // True where the key, or the button, was for the tool.
    bool onKey(Key key, const BuildView& view);
    bool onButton(MouseButton button, const BuildView& view);
    // What is open, pasted or selected is no more, one thing a call. False where there is nothing.
    bool close();

    void draw(const Screen& screen, const render::Camera& camera, const BuildView& view);
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
    void drawPanel(const Screen& screen, const BuildView& view);
    void drawName(const Texts& tr);
    void drawFiles(const Texts& tr);
    void drawOutlines(const Screen& screen, const render::Camera& camera, const BuildView& view) const;

    std::filesystem::path folder_;
    game::Selection selection_;
    std::optional<ToolAction> pressed_;  // a button of the panel
    bool isActive_ = false;
    Asks asks_ = Asks::Nothing;
    bool takesFocus_ = false, isAnswered_ = false;
    std::array<char, 101> name_{};  // that is typed: a file's
    std::vector<std::string> files_;
    std::size_t file_ = 0;  // that is chosen
    std::optional<std::string> message_;
};

}  // namespace terrane::app
