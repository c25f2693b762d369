// The title screen: continue, worlds, a new world, servers, settings, quit, over a slow flight through a
// world. It runs until a world is chosen or the player leaves. Used on the thread of the OpenGL context.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/input.h"
#include "apps/terrane/window/settings/settings_dialog.h"
#include "apps/terrane/window/text.h"
#include "apps/terrane/window/title/join_dialog.h"
#include "apps/terrane/window/title/new_world_form.h"
#include "apps/terrane/window/title/title_background.h"
#include "apps/terrane/window/title/world_shelf.h"
#include "terrane/base/process.h"

namespace terrane::app {

// A local world, or a server's.
using TitleChoice = std::variant<ChosenWorld, RemoteOptions>;

class TitleScreen {
  public:
    // All outlive the title.
    struct Parts {
        Window& window;
        const base::StopSignals& signals;
        const PlayOptions& options;
        const ScreenOptions& screen;
        const pack::Content& content;
        std::filesystem::path folder;  // of the worlds
    };

    // `message`: shown first, such as why a world could not be opened; empty: none.
    TitleScreen(const Parts& parts, PlaySettings& settings, std::string message);

    // Returns the choice; none to quit.
    base::Result<std::optional<TitleChoice>> run();

  private:
    enum class Page : std::uint8_t {
        Main,
        Worlds,
        NewWorld,
        Join,
        Rename,
        Copy,
        Copying,
        Delete,
        Settings,
        Message
    };

    void handleEvents();
    void onKey(Key key);
    void onPad();
    void back();
    void open(Page page);
    void showMessage(std::string text);
    void openBackground();
    base::Result<void> drawFrame(double seconds);
    void drawOpening();

    // The pages.
    void drawPage(const Screen& screen);
    void drawMain(const Screen& screen);
    void drawWorlds(const Screen& screen);
    void drawRow(std::size_t index);
    void drawWorldButtons();
    void drawNewWorld(const Screen& screen);
    void drawForm();
    void drawHeights();
    void drawMap(float side);
    void drawJoin(const Screen& screen);
    void drawName(const Screen& screen);
    void drawCopying(const Screen& screen);
    void drawDelete(const Screen& screen);
    void drawMessage(const Screen& screen);
    void play(const store::WorldEntry& world);
    void create();
    void changeName();
    template <class Change>
    void changeChosen(Change change);

    Parts parts_;
    PlaySettings& settings_;
    std::string language_;  // language of tr_
    Texts tr_;
    ImguiLayer imgui_;
    PadReader pad_;
    std::optional<TitleBackground> background_;
    WorldShelf shelf_;
    MapPreview map_;
    NewWorldForm form_;
    JoinDialog join_;
    SettingsDialog dialog_;
    std::vector<Page> pages_{Page::Main};  // the last one is shown
    std::string nameText_, message_;
    std::optional<TitleChoice> choice_;
    bool quits_ = false;
};

}  // namespace terrane::app
