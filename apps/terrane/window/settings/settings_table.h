// The player's settings as one table: the command line of `terrane play`, settings.toml, the settings dialog
// and the developers' panel all follow from it. A new setting is a member of PlaySettings and a row here; a
// setting of drawing is a member of render::RenderOptions and a row of render::graphicsTable(). Pure; any
// thread.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/terrane/window/settings/play_settings.h"

namespace terrane::app {

// The headings of the settings dialog, in the order of its pages. Hidden: only in the panel.
enum class SettingsSection : std::uint8_t {
    View,
    Details,
    Input,
    Time,
    Movement,
    LanguageAndSound,
    Accessibility,
    Hidden
};

struct SwitchSetting {
    bool (*get)(const PlaySettings&);
    void (*set)(PlaySettings&, bool);
};

struct NumberSetting {
    double (*get)(const PlaySettings&) = nullptr;
    void (*set)(PlaySettings&, double) = nullptr;
    double low = 0, high = 1;
    int decimals = 0;            // of the saved text
    const char* shown = "%.0f";  // to the player, translated; printf format of the value times `factor`
    double factor = 1;
    bool isLogarithmic = false;      // of the slider
    std::vector<double> stops = {};  // the dialog offers these values and no slider
};

struct ChoiceSetting {
    std::vector<std::string> names;               // of the values: command line and settings.toml
    std::vector<const char*> labels = {};         // for the player, translated; empty: the names
    std::function<int(const PlaySettings&)> get;  // the value's index; −1: none of them
    std::function<void(PlaySettings&, int)> set;
    std::function<std::optional<int>(std::string_view)> former = {};  // value of a name of earlier versions
};

struct Setting {
    std::string_view name;  // the option without dashes, and the key in settings.toml
    std::string_view help;  // for the command line and the panel, in English
    SettingsSection section = SettingsSection::Hidden;
    const char* label = nullptr;  // for the player, translated
    const char* tip = nullptr;    // effect and cost; null: none
    std::variant<SwitchSetting, NumberSetting, ChoiceSetting> kind = {};
    const render::GraphicsRow* graphics = nullptr;  // the setting is this row of drawing
    bool isSaved = true;                            // in settings.toml, rather than in each world
};

// In the order in which dialog and panel show them.
std::span<const Setting> settingsTable();

// The value's text on the command line and in settings.toml.
std::string textOf(const Setting& setting, const PlaySettings& settings);

// Adds an option for each setting, except those of drawing, which addGraphicsOptions() adds for all commands
// that draw.
void addSettings(CLI::App& command, PlaySettings& settings);

// The saved settings that differ from the defaults, or from those of the preset.
SettingValues valuesOf(const PlaySettings& settings, bool isSoftwareRenderer);

}  // namespace terrane::app
