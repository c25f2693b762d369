// The settings dialog of the title screen and the pause menu: graphics, controls, world, general.
// Developers have a panel of their own (panel.h). Immediate mode: draws and changes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/settings/settings_table.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/player_state.h"

namespace terrane::app {

enum class SettingsPage : std::uint8_t { Graphics, Controls, World, General, kCount };

class SettingsDialog {
  public:
    struct Input {
        Screen screen;
        const Texts& tr;
        bool isSoftwareRenderer = false;
        game::DayClock* day = nullptr;  // of the current world; null on the title screen
    };

    // True when the player is done.
    bool draw(PlaySettings& settings, const Input& input);

    // Binds the key to the action that waits for one; Escape cancels. False if no action waits.
    bool takeKey(Key key, PlaySettings& settings, const Texts& tr);
    // The same for a gamepad, once per frame; Start cancels. True while the gamepad does nothing else: until
    // all of its buttons are released.
    bool takePad(const PadReader& pad, PlaySettings& settings, const Texts& tr);
    // To the previous or next page, for a gamepad's bumpers.
    void turnPage(int by);
    void open() { *this = SettingsDialog(); }

  private:
    void drawTabs(const Texts& tr);
    void drawPage(PlaySettings& settings, const Input& input);
    void drawKeys(PlaySettings& settings, const Texts& tr);
    void drawBinding(const ActionRow& row, bool isPad, const std::string& shown);
    template <class Pressed>
    void bind(Bindings<Pressed>& bindings, Pressed pressed, const std::string& shown, const Texts& tr);

    SettingsPage page_ = SettingsPage::Graphics;
    std::optional<Action> waiting_;
    bool waitsForPad_ = false;  // for a button of the gamepad, else for a key
    bool holdsPad_ = false;     // a button that was bound is still down
    std::string note_;          // which action lost its key
};

// A widget of a setting. With `tr` in words for players, else by its names.
void drawSetting(const Setting& setting, PlaySettings& settings, const Texts* tr);

}  // namespace terrane::app
