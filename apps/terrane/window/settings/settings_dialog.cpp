#include "apps/terrane/window/settings/settings_dialog.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/settings/key_help.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {

namespace {

constexpr std::array<const char*, static_cast<std::size_t>(SettingsPage::kCount)> kPages = {
    trLater("Graphics"), trLater("Controls"), trLater("World"), trLater("General")};

}  // namespace

bool SettingsDialog::draw(PlaySettings& settings, const Input& input) {
    const float scale = uiScale(), margin = 12 * scale;
    const Screen& screen = input.screen;
    const ImVec2 size(std::min(520 * scale, screen.width - 2 * margin),
                      std::min(440 * scale, screen.height - 2 * margin));
    const std::string title = input.tr("Settings") + std::string("###settings");  // same id in every language
    beginMenu({title.c_str(), {screen.width / 2, screen.height / 2}, size});
    drawTabs(input.tr);
    const float footer = ImGui::GetFrameHeightWithSpacing() + 10 * scale;
    ImGui::BeginChild("page", {0, -footer}, false, ImGuiWindowFlags_NavFlattened);
    ImGui::PushItemWidth(170 * scale);
    drawPage(settings, input);
    ImGui::PopItemWidth();
    ImGui::EndChild();
    ImGui::Separator();
    const bool isDone = ui::button(input.tr("Done (Esc)"), {-1, 0});
    ImGui::End();
    if (isDone || page_ != SettingsPage::Controls) waiting_.reset();
    return isDone;
}

void SettingsDialog::drawTabs(const Texts& tr) {
    const float gap = ImGui::GetStyle().ItemSpacing.x, count = static_cast<float>(kPages.size());
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    for (std::size_t k = 0; k < kPages.size(); ++k) {
        if (k > 0) ImGui::SameLine();
        const auto page = static_cast<SettingsPage>(k);
        if (tabButton(tr(kPages[k]), page == page_, width)) page_ = page;
        if (page == page_ && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    }
    ImGui::Separator();
}

void SettingsDialog::turnPage(int by) {
    const int count = static_cast<int>(kPages.size());
    page_ = static_cast<SettingsPage>((static_cast<int>(page_) + by + count) % count);
    waiting_.reset();
}

void SettingsDialog::drawBinding(const ActionRow& row, bool isPad, const std::string& shown) {
    ImGui::TableNextColumn();
    const bool isWaiting = waiting_ == row.action && waitsForPad_ == isPad;
    const std::string label = (isWaiting ? "..." : shown) + (isPad ? "###pad" : "###key");
    if (!ui::button(label.c_str(), {-1, 0}, row.name)) return;
    waiting_ = row.action;
    waitsForPad_ = isPad;
}

void SettingsDialog::drawKeys(PlaySettings& settings, const Texts& tr) {
    if (waiting_) {
        const char* asks =
            waitsForPad_ ? tr("Press the new gamepad button for \"{}\", or Start or Esc to keep the old one.")
                         : tr("Press the new key for \"{}\", or Esc to keep the old one.");
        ImGui::PushStyleColor(ImGuiCol_Text, colors::kAccent);
        ui::wrappedText(fmt::format(fmt::runtime(asks), tr(rowOf(*waiting_).label)));
        ImGui::PopStyleColor();
    } else {
        dimText(note_.empty() ? std::string(tr("Choose a key or button to change it.")) : note_);
    }
    if (!ImGui::BeginTable("keys", 3, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("action", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 90 * uiScale());
    ImGui::TableSetupColumn("gamepad", ImGuiTableColumnFlags_WidthFixed, 120 * uiScale());
    for (const ActionRow& row : actionTable()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        const auto key = settings.keys.keyOf(row.action);
        const auto button = settings.padButtons.keyOf(row.action);
        ImGui::TextColored(key || button ? colors::kText : colors::kWarning, "%s", tr(row.label));
        ImGui::PushID(static_cast<int>(row.action));
        drawBinding(row, false, keyText(key, tr));
        drawBinding(row, true, padButtonText(button, tr));
        ImGui::PopID();
    }
    ImGui::EndTable();
    ImGui::Spacing();
    if (menuButton(tr("Default keys"), 140 * uiScale(),
                   !settings.keys.isUsual() || !settings.padButtons.isUsual())) {
        settings.keys = {};
        settings.padButtons = {};
        note_ = tr("All keys and buttons have their defaults.");
    }
}

template <class Pressed>
void SettingsDialog::bind(Bindings<Pressed>& bindings, Pressed pressed, const std::string& shown,
                          const Texts& tr) {
    const Action action = *std::exchange(waiting_, std::nullopt);
    if (!canBeBound(pressed)) return;
    const auto loser = bindings.bind(action, pressed);
    note_ = loser ? fmt::format(fmt::runtime(tr("{} was \"{}\", which has none now.")), shown,
                                tr(rowOf(*loser).label))
                  : fmt::format(fmt::runtime(tr("{} is \"{}\".")), shown, tr(rowOf(action).label));
}

bool SettingsDialog::takeKey(Key key, PlaySettings& settings, const Texts& tr) {
    if (!waiting_) return false;
    if (waitsForPad_ && key == Key::Escape) waiting_.reset();
    if (!waitsForPad_) bind(settings.keys, key, keyText(key, tr), tr);
    return true;
}

bool SettingsDialog::takePad(const PadReader& pad, PlaySettings& settings, const Texts& tr) {
    const auto button = pad.pressed();
    if (waiting_ && waitsForPad_ && button) {
        bind(settings.padButtons, *button, padButtonText(*button, tr), tr);
        holdsPad_ = true;
        return true;
    }
    holdsPad_ = holdsPad_ && pad.isAnyDown();
    return holdsPad_ || (waiting_ && waitsForPad_);
}

namespace {

void drawNumber(const NumberSetting& number, const char* label, PlaySettings& settings, const Texts* tr) {
    const auto low = static_cast<float>(number.low * number.factor),
               high = static_cast<float>(number.high * number.factor);
    auto value = static_cast<float>(number.get(settings) * number.factor);
    const ImGuiSliderFlags flags = number.isLogarithmic ? ImGuiSliderFlags_Logarithmic : 0;
    if (ui::slider(label, &value, low, high, tr ? (*tr)(number.shown) : number.shown, flags))
        number.set(settings, double{value} / number.factor);
}

void drawStops(const NumberSetting& number, const char* label, PlaySettings& settings, const Texts& tr) {
    const auto textOf = [&](double value) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), tr(number.shown), value * number.factor);
        return std::string(text.data());
    };
    if (!ui::beginCombo(label, textOf(number.get(settings)).c_str())) return;
    for (const double stop : number.stops)
        if (ui::selectable(textOf(stop).c_str(), number.get(settings) == stop)) number.set(settings, stop);
    ImGui::EndCombo();
}

void drawChoice(const ChoiceSetting& choice, const char* label, PlaySettings& settings, const Texts* tr) {
    const auto textOf = [&](std::size_t k) {
        return tr && k < choice.labels.size() ? (*tr)(choice.labels[k]) : choice.names[k].c_str();
    };
    const int now = choice.get(settings);
    const char* none = tr ? (*tr)(trLater("Other")) : "custom";
    if (!ui::beginCombo(label, now >= 0 ? textOf(static_cast<std::size_t>(now)) : none)) return;
    for (std::size_t k = 0; k < choice.names.size(); ++k)
        if (ui::selectable(textOf(k), static_cast<int>(k) == now)) choice.set(settings, static_cast<int>(k));
    ImGui::EndCombo();
}

void drawSwitch(bool isOn, const char* label, const std::function<void(bool)>& set) {
    if (ui::checkbox(label, &isOn)) set(isOn);
}

}  // namespace

void drawSetting(const Setting& setting, PlaySettings& settings, const Texts* tr) {
    // The same id in every language, so that a list stays open when it changes the language.
    const std::string name(setting.name), label = tr ? (*tr)(setting.label) + ("###" + name) : name;
    const char* const shown = label.c_str();
    if (const auto* isOn = std::get_if<SwitchSetting>(&setting.kind))
        drawSwitch(isOn->get(settings), shown, [&](bool value) { isOn->set(settings, value); });
    else if (const auto* number = std::get_if<NumberSetting>(&setting.kind))
        tr && !number->stops.empty() ? drawStops(*number, shown, settings, *tr)
                                     : drawNumber(*number, shown, settings, tr);
    else if (const auto& choice = std::get<ChoiceSetting>(setting.kind);
             setting.graphics && setting.graphics->isSwitch())
        drawSwitch(choice.get(settings) == 1, shown,
                   [&](bool value) { choice.set(settings, value ? 1 : 0); });
    else
        drawChoice(choice, shown, settings, tr);
    if (!tr)
        tooltipFor(std::string(setting.help).c_str());
    else if (setting.tip)
        tooltipFor((*tr)(setting.tip));
}

namespace {

struct Heading {
    SettingsPage page;
    const char* text;
};

// In the order of SettingsSection, without Hidden.
constexpr std::array<Heading, 7> kHeadings = {{{SettingsPage::Graphics, trLater("View")},
                                               {SettingsPage::Graphics, trLater("Details")},
                                               {SettingsPage::Controls, trLater("Mouse and gamepad")},
                                               {SettingsPage::World, trLater("Time")},
                                               {SettingsPage::World, trLater("Movement")},
                                               {SettingsPage::General, trLater("Language and sound")},
                                               {SettingsPage::General, trLater("Accessibility")}}};
static_assert(kHeadings.size() == static_cast<std::size_t>(SettingsSection::Hidden),
              "a heading for each section");

void drawQualityButton(PlaySettings& s, const char* preset, const char* label, bool isSoftwareRenderer,
                       float width) {
    if (!tabButton(label, s.preset == preset, width)) return;
    s.preset = preset;
    s.graphics = render::withPreset(s.graphics, s.preset, isSoftwareRenderer);
}

std::string aboutPreset(const render::Preset& preset, const Texts& tr) {
    std::string text = tr(preset.about);
    if (preset.relativeCost.value_or(1) > 1)
        text += '\n' + fmt::format(fmt::runtime(tr("A frame takes {:.1f} times as long as with low.")),
                                   *preset.relativeCost);
    return text;
}

void drawQuality(PlaySettings& s, bool isSoftwareRenderer, const Texts& tr) {
    const auto isForPlayers = [](const render::Preset& preset) { return preset.label != nullptr; };
    const float gap = ImGui::GetStyle().ItemSpacing.x,
                count = 1 + static_cast<float>(std::ranges::count_if(render::presets(), isForPlayers));
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    heading(tr("Quality"));
    drawQualityButton(s, "auto", tr("Auto"), isSoftwareRenderer, width);
    tooltipFor(tr("High on a graphics card, low without one."));
    for (const render::Preset& preset : render::presets()) {
        if (!isForPlayers(preset)) continue;
        ImGui::SameLine();
        drawQualityButton(s, std::string(preset.name).c_str(), tr(preset.label), isSoftwareRenderer, width);
        tooltipFor(aboutPreset(preset, tr).c_str());
    }
}

void drawClock(game::DayClock& day, const Texts& tr) {
    auto time = static_cast<float>(day.timeDay) * 24;
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%02d:%02d", static_cast<int>(time) % 24,
                  static_cast<int>(time * 60) % 60);
    if (ui::slider(tr("Time of day"), &time, 0, 24, text.data()))
        day.timeDay = std::min(double{time} / 24, 0.99999);
    ui::checkbox(tr("Time runs"), &day.isRunning);
}

}  // namespace

// The rows of the page by heading, and around them what is not a setting.
void SettingsDialog::drawPage(PlaySettings& settings, const Input& input) {
    if (page_ == SettingsPage::Graphics) drawQuality(settings, input.isSoftwareRenderer, input.tr);
    for (std::size_t k = 0; k < kHeadings.size(); ++k) {
        const auto section = static_cast<SettingsSection>(k);
        if (kHeadings[k].page != page_) continue;
        // Each world has its own.
        if (section == SettingsSection::Movement && !input.day) {
            dimText(input.tr("Each world has its own time and movement mode:\nplay it to change them."));
            continue;
        }
        heading(input.tr(kHeadings[k].text));
        if (section == SettingsSection::Time && input.day) drawClock(*input.day, input.tr);
        for (const Setting& setting : settingsTable())
            if (setting.section == section) drawSetting(setting, settings, &input.tr);
    }
    if (page_ != SettingsPage::Controls) return;
    heading(input.tr("Keys and buttons"));
    drawKeys(settings, input.tr);
}

}  // namespace terrane::app
