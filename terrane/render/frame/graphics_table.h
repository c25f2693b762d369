// Every graphics option as one row of a table: its names, values, texts, and access to its member. The
// command line, settings and menus are generated from it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/render/frame/render_options.h"

namespace terrane::render {

struct GraphicsRow {
    std::string_view name;                     // of the flag, without dashes, and of the setting
    std::string_view description;              // for the command line and developers
    std::vector<std::string_view> valueNames;  // of its values, in order
    int (*get)(const GraphicsSettings&);       // the value's index
    void (*set)(GraphicsSettings&, int value);
    // For players, in English; the program translates them. No label: only developers see the row.
    const char* label = nullptr;
    const char* tip = nullptr;                  // effect and cost, from docs/rendering.md
    std::vector<const char*> valueLabels = {};  // empty for a switch
    bool isOfPreset = true;                     // a preset sets it

    bool isSwitch() const {
        return valueNames.size() == 2 && valueNames[0] == "off" && valueNames[1] == "on";
    }
};

std::span<const GraphicsRow> graphicsTable();
std::vector<std::string> namesOfPreset();          // of the rows that a preset sets
std::string valueNamesOf(const GraphicsRow& row);  // "off, on"
std::optional<int> choiceOf(const GraphicsRow& row, std::string_view name);

// Choices of a user: a preset, then single rows.
struct GraphicsChoices {
    std::string preset;
    std::vector<std::pair<std::size_t, int>> changed = {};  // row, value
    std::optional<int> viewDistance = {};
};

std::string presetNames();                               // "auto, low, …"
std::string presetNameError(const std::string& preset);  // empty if it is valid
GraphicsSettings settingsOf(const GraphicsChoices& choices, bool isSoftwareRenderer);

}  // namespace terrane::render
