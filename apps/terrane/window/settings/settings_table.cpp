#include "apps/terrane/window/settings/settings_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/terrane/window/text.h"

namespace terrane::app {

EnumNames<game::Movement> movementNames() {
    static const std::array<std::pair<std::string, game::Movement>, 3> valueNames = {
        {{"walk", game::Movement::Walk}, {"fly", game::Movement::Fly}, {"noclip", game::Movement::Noclip}}};
    return valueNames;
}

const std::string& nameOf(game::Movement movement) {
    return movementNames()[static_cast<std::size_t>(movement)].first;
}

std::optional<game::Movement> movementNamed(std::string_view name) {
    for (const auto& [known, movement] : movementNames())
        if (known == name) return movement;
    // Of earlier versions, in saves and scripts.
    constexpr std::array<std::pair<std::string_view, game::Movement>, 4> kFormer = {
        {{"gravity", game::Movement::Walk},
         {"walls", game::Movement::Fly},
         {"medium", game::Movement::Noclip},
         {"fast", game::Movement::Noclip}}};
    for (const auto& [former, movement] : kFormer)
        if (former == name) return movement;
    return std::nullopt;
}

namespace {

using Section = SettingsSection;

template <auto kMember>
SwitchSetting switchOf() {
    return {[](const PlaySettings& s) { return s.*kMember; },
            [](PlaySettings& s, bool isOn) { s.*kMember = isOn; }};
}

template <auto kMember>
NumberSetting numberOf(NumberSetting number) {
    using Value = std::remove_cvref_t<decltype(PlaySettings().*kMember)>;
    number.get = [](const PlaySettings& s) { return static_cast<double>(s.*kMember); };
    number.set = [](PlaySettings& s, double value) { s.*kMember = static_cast<Value>(value); };
    return number;
}

ChoiceSetting movementChoice() {
    ChoiceSetting choice;
    for (const auto& [name, movement] : movementNames()) choice.names.push_back(name);
    choice.labels = {trLater("Walk"), trLater("Fly"), trLater("Fly through blocks")};
    choice.get = [](const PlaySettings& s) { return static_cast<int>(s.movement); };
    choice.set = [](PlaySettings& s, int value) { s.movement = static_cast<game::Movement>(value); };
    choice.former = [](std::string_view name) {
        const auto movement = movementNamed(name);
        return movement ? std::optional(static_cast<int>(*movement)) : std::nullopt;
    };
    return choice;
}

ChoiceSetting targetFpsChoice() {
    static constexpr std::array kRates = {
        PlaySettings::kAutomaticRate, 0, 30, 45, 60, 75, 90, 120, 144, 165, 240};
    ChoiceSetting choice;
    choice.names = {"auto", "off"};
    choice.labels = {trLater("Automatic"), trLater("Off")};
    choice.get = [](const PlaySettings& s) {
        return static_cast<int>(std::ranges::find(kRates, s.targetFps) - kRates.begin());
    };
    choice.set = [](PlaySettings& s, int value) { s.targetFps = kRates[static_cast<std::size_t>(value)]; };
    static const auto kTexts = [] {
        std::array<std::string, kRates.size()> texts;
        for (std::size_t k = 2; k < kRates.size(); ++k) texts[k] = std::to_string(kRates[k]);
        return texts;
    }();
    for (std::size_t k = 2; k < kRates.size(); ++k) {
        choice.names.push_back(kTexts[k]);
        choice.labels.push_back(kTexts[k].c_str());
    }
    return choice;
}

// Each language has its own name, so that everyone finds theirs.
ChoiceSetting languageChoice() {
    ChoiceSetting choice;
    for (const auto& [name, code] : languageChoices()) choice.names.push_back(name);
    choice.labels = {trLater("System language"), "English", "Čeština", "Deutsch"};
    choice.get = [names = choice.names](const PlaySettings& s) {
        const auto found = std::ranges::find(names, s.language);
        return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    };
    choice.set = [names = choice.names](PlaySettings& s, int value) {
        s.language = names[static_cast<std::size_t>(value)];
    };
    return choice;
}

Setting graphicsSetting(const render::GraphicsRow& row) {
    Setting setting{.name = row.name,
                    .help = row.description,
                    .section = !row.label       ? Section::Hidden
                               : row.isOfPreset ? Section::Details
                                                : Section::View,
                    .label = row.label,
                    .tip = row.tip,
                    .graphics = &row};
    setting.kind = ChoiceSetting{.names = {row.valueNames.begin(), row.valueNames.end()},
                                 .labels = row.valueLabels,
                                 .get = [&row](const PlaySettings& s) { return row.get(s.graphics); },
                                 .set = [&row](PlaySettings& s, int value) { row.set(s.graphics, value); }};
    return setting;
}

std::vector<Setting> makeTable() {
    std::vector<Setting> table = {
        {"view-distance", "View distance in chunks", Section::View, trLater("View distance"),
         trLater(
             "In chunks of 16 blocks, which are shown in full.\nCost: high; memory grows with the square."),
         NumberSetting{
             .get = [](const PlaySettings& s) { return static_cast<double>(s.graphics.viewDistance); },
             .set = [](PlaySettings& s,
                       double value) { s.graphics.viewDistance = static_cast<int>(std::lround(value)); },
             .low = 1,
             .high = render::kMaxViewDistance,
             .shown = trLater("%.0f chunks")}},
        {"field-of-view", "Vertical field of view in degrees", Section::View, trLater("Field of view"),
         trLater("Vertical.\nCost: a little higher if it is wider."),
         numberOf<&PlaySettings::fieldOfView>({.low = 40, .high = 110, .shown = trLater("%.0f degrees")})},
        {"target-fps",
         "Frames a second to hold: the world is drawn smaller where it takes too long; auto: the rate of the "
         "monitor, or 30 without a graphics card",
         Section::View, trLater("Frames per second"),
         trLater("Held by drawing the world smaller where it takes too long, down to half the render scale."),
         targetFpsChoice()},
        {"frame-limit", "The most frames a second; 0: no limit", Section::View, trLater("Frame limit"),
         trLater("The most frames per second; 0: no limit. Saves power."),
         numberOf<&PlaySettings::frameLimit>({.low = 0, .high = 1000, .shown = "%.0f"})},
        {"vsync", "Frames wait for the screen: never, always, or only those that are in time (adaptive)",
         Section::View, trLater("Vertical sync"),
         trLater("Frames wait for the screen, so that no image is torn.\nAdaptive: late frames do not wait."),
         ChoiceSetting{.names = {"off", "on", "adaptive"},
                       .labels = {trLater("Off"), trLater("On"), trLater("Adaptive")},
                       .get = [](const PlaySettings& s) { return static_cast<int>(s.vsync); },
                       .set = [](PlaySettings& s, int value) { s.vsync = static_cast<Vsync>(value); }}},
        {"full-screen", "Use the whole screen", Section::View, trLater("Full screen"), nullptr,
         switchOf<&PlaySettings::fullScreen>()},
    };
    for (const render::GraphicsRow& row : render::graphicsTable()) table.push_back(graphicsSetting(row));
    const std::vector<Setting> others = {
        {"mouse-sensitivity", "Degrees per step of the mouse", Section::Input, trLater("Mouse sensitivity"),
         trLater("Degrees that the view turns per step of the mouse."),
         numberOf<&PlaySettings::mouseSensitivity>(
             {.low = 0.02, .high = 0.6, .decimals = 2, .shown = "%.2f"})},
        {"invert-y", "Invert the vertical axis of mouse and stick", Section::Input,
         trLater("Invert up and down"), trLater("Moving the mouse or the stick forward looks down."),
         switchOf<&PlaySettings::invertY>()},
        {"auto-jump", "Climb steps of one block without jumping", Section::Input,
         trLater("Jump automatically"), trLater("Climb steps of one block by walking against them."),
         switchOf<&PlaySettings::autoJump>()},
        {"day-minutes", "Length of a day in minutes", Section::Time, trLater("Minutes per day"),
         trLater("Length of a day of the world."),
         numberOf<&PlaySettings::dayMinutes>(
             {.low = 0.5, .high = 1440, .decimals = 1, .shown = "%.1f", .isLogarithmic = true})},
        {.name = "movement",
         .help = "Movement mode",
         .section = Section::Movement,
         .label = trLater("Movement mode"),
         .kind = movementChoice(),
         .isSaved = false},
        {"language", "Language of names and menus; auto: the system's language", Section::LanguageAndSound,
         trLater("Language"), nullptr, languageChoice()},
        {"sound-volume", "Volume of sounds, 0 (none) to 1", Section::LanguageAndSound,
         trLater("Sound volume"), nullptr,
         numberOf<&PlaySettings::soundVolume>(
             {.low = 0, .high = 1, .decimals = 2, .shown = "%.0f %%", .factor = 100})},
        {"text-size", "Scale of texts and menus", Section::Accessibility, trLater("Text size"),
         trLater("Size of all texts and menus."),
         numberOf<&PlaySettings::textSize>({.low = 0.5,
                                            .high = 3,
                                            .decimals = 2,
                                            .shown = "%.0f %%",
                                            .factor = 100,
                                            .stops = {0.75, 1, 1.25, 1.5, 1.75, 2}})},
        {"high-contrast", "Thick outline around the targeted block", Section::Accessibility,
         trLater("High contrast"),
         trLater("The targeted block gets thick lines in black, white and orange, for color-blind players."),
         switchOf<&PlaySettings::highContrast>()},
        {"reduced-motion", "No motion of the arm and of the world behind the title", Section::Accessibility,
         trLater("Reduced motion"), trLater("The world behind the title stands still."),
         switchOf<&PlaySettings::reducedMotion>()},
        {.name = "hint-seen",
         .help = "Do not show the hint of the first start, which was seen",
         .kind = switchOf<&PlaySettings::hintSeen>()},
    };
    table.insert(table.end(), others.begin(), others.end());
    return table;
}

void addChoiceOption(CLI::App& command, const Setting& setting, const ChoiceSetting& choice,
                     PlaySettings& settings) {
    const std::string flag = "--" + std::string(setting.name);
    const auto take = [flag, choice, &settings](const std::string& text) {
        const auto found = std::ranges::find(choice.names, currentValue(text));
        const bool isCurrent = found != choice.names.end();
        const std::optional<int> former = isCurrent || !choice.former ? std::nullopt : choice.former(text);
        if (!isCurrent && !former) throw CLI::ValidationError(flag, base::expectedOneOf(choice.names, text));
        choice.set(settings, former ? *former : static_cast<int>(found - choice.names.begin()));
    };
    command
        .add_option_function<std::string>(flag, take,
                                          fmt::format("{}: {}", setting.help, fmt::join(choice.names, ", ")))
        ->type_name("CHOICE")
        ->default_str(textOf(setting, settings));
}

void addNumberOption(CLI::App& command, const Setting& setting, const NumberSetting& number,
                     PlaySettings& settings) {
    const auto take = [&number, &settings](double value) { number.set(settings, value); };
    command.add_option_function<double>("--" + std::string(setting.name), take, std::string(setting.help))
        ->check(numberFrom(number.low, number.high))
        ->default_str(fmt::format("{:g}", number.get(settings)));
}

template <class Input>
CLI::Option& addBindingsOption(CLI::App& command, const char* flag, Bindings<Input>& bindings,
                               base::Result<Bindings<Input>> (*parse)(std::string_view), const char* help) {
    const auto take = [flag, parse, &bindings](const std::string& text) {
        auto parsed = parse(text);
        if (!parsed) throw CLI::ValidationError(flag, parsed.error().message);
        bindings = *parsed;
    };
    return *command.add_option_function<std::string>(flag, take, help);
}

}  // namespace

std::span<const Setting> settingsTable() {
    static const std::vector<Setting> table = makeTable();
    return table;
}

std::string textOf(const Setting& setting, const PlaySettings& settings) {
    if (const auto* isOn = std::get_if<SwitchSetting>(&setting.kind))
        return isOn->get(settings) ? "true" : "false";
    if (const auto* number = std::get_if<NumberSetting>(&setting.kind))
        return fmt::format("{:.{}f}", number->get(settings), number->decimals);
    const auto& choice = std::get<ChoiceSetting>(setting.kind);
    const int value = choice.get(settings);
    return value < 0 ? std::string() : choice.names[static_cast<std::size_t>(value)];
}

void addSettings(CLI::App& command, PlaySettings& settings) {
    for (const Setting& setting : settingsTable()) {
        if (setting.graphics || setting.name == "view-distance") continue;
        if (const auto* isOn = std::get_if<SwitchSetting>(&setting.kind))
            command.add_flag_callback(
                "--" + std::string(setting.name), [isOn, &settings] { isOn->set(settings, true); },
                std::string(setting.help));
        else if (const auto* number = std::get_if<NumberSetting>(&setting.kind))
            addNumberOption(command, setting, *number, settings);
        else
            addChoiceOption(command, setting, std::get<ChoiceSetting>(setting.kind), settings);
    }
    addBindingsOption(command, "--keys", settings.keys, keyBindingsFrom,
                      "Keys that differ from the defaults, such as jump=F,run=R,chat=Mouse4")
        .type_name("ACTION=KEY,...");
    addBindingsOption(command, "--pad-buttons", settings.padButtons, padBindingsFrom,
                      "Gamepad buttons that differ from the defaults, such as jump=West,run=LeftStick")
        .type_name("ACTION=BUTTON,...");
}

SettingValues valuesOf(const PlaySettings& s, bool isSoftwareRenderer) {
    PlaySettings usual;
    usual.graphics = render::settingsOf({s.preset}, isSoftwareRenderer);
    SettingValues values = {{"preset", s.preset}};
    for (const Setting& setting : settingsTable()) {
        const std::string text = textOf(setting, s);
        if (setting.isSaved && text != textOf(setting, usual)) values.emplace(setting.name, text);
    }
    if (const std::string keys = textOf(s.keys); !keys.empty()) values.emplace("keys", keys);
    if (const std::string buttons = textOf(s.padButtons); !buttons.empty())
        values.emplace("pad-buttons", buttons);
    return values;
}

}  // namespace terrane::app
