#include "apps/terrane/window/settings/settings_dialog.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

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
    switch (page_) {
        case SettingsPage::Graphics:
            drawGraphicsPage(settings, input.isSoftwareRenderer, input.tr);
            break;
        case SettingsPage::Controls:
            drawControls(settings, input.tr);
            break;
        case SettingsPage::World:
            drawWorldPage(settings, input.day, input.tr);
            break;
        default:
            drawGeneralPage(settings, input.tr);
    }
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

void SettingsDialog::drawControls(PlaySettings& settings, const Texts& tr) {
    heading(tr("Mouse and gamepad"));
    ui::slider(tr("Mouse sensitivity"), &settings.mouseSensitivity, 0.02f, 0.6f, "%.2f");
    tooltipFor(tr("Degrees that the view turns per step of the mouse."));
    ui::checkbox(tr("Invert up and down"), &settings.invertY);
    tooltipFor(tr("Moving the mouse or the stick forward looks down."));
    ui::checkbox(tr("Jump automatically"), &settings.autoJump);
    tooltipFor(tr("Climb steps of one block by walking against them."));
    heading(tr("Keys"));
    drawKeys(settings.keys, tr);
}

void SettingsDialog::drawKeys(KeyBindings& keys, const Texts& tr) {
    if (waiting_) {
        ImGui::TextColored(
            colors::kAccent, "%s",
            fmt::format(fmt::runtime(tr("Press the new key for \"{}\", or Esc to keep the old one.")),
                        tr(rowOf(*waiting_).label))
                .c_str());
    } else {
        dimText(note_.empty() ? std::string(tr("Choose a key to change it.")) : note_);
    }
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("action", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, 120 * uiScale());
    for (const ActionRow& row : actionTable()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        const auto key = keys.keyOf(row.action);
        ImGui::TextColored(key ? colors::kText : colors::kWarning, "%s", tr(row.label));
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(row.action));
        const std::string name = waiting_ == row.action ? "..." : keyText(key, tr);
        if (ui::button((name + "###key").c_str(), {-1, 0}, row.name)) waiting_ = row.action;
        ImGui::PopID();
    }
    ImGui::EndTable();
    ImGui::Spacing();
    if (menuButton(tr("Default keys"), 140 * uiScale(), !keys.isUsual())) {
        keys = KeyBindings();
        note_ = tr("All keys have their defaults.");
    }
}

bool SettingsDialog::takeKey(Key key, PlaySettings& settings, const Texts& tr) {
    if (!waiting_) return false;
    const Action action = *waiting_;
    waiting_.reset();
    if (!canBeBound(key)) return true;
    const auto loser = settings.keys.bind(action, key);
    note_ = loser ? fmt::format(fmt::runtime(tr("{} was \"{}\", which has no key now.")), keyText(key, tr),
                                tr(rowOf(*loser).label))
                  : fmt::format(fmt::runtime(tr("{} is \"{}\".")), keyText(key, tr), tr(rowOf(action).label));
    return true;
}

// The pages of the settings dialog that show values of settings.

namespace {

// Texts of a row of the graphics table. Costs are from docs/rendering.md, "What a preset costs".
struct PlainRow {
    const char* name;  // of the row
    const char* label;
    const char* help;  // effect and cost
    std::array<const char*, 7> words;
};

constexpr PlainRow kRows[] = {
    {"horizon",
     trLater("Distant land"),
     trLater("How far coarser land continues beyond the view distance.\nCost: medium, also in memory."),
     {trLater("None"), trLater("2 km"), trLater("4 km"), trLater("8 km"), trLater("16 km"), trLater("33 km"),
      trLater("65 km")}},
    {"shadows",
     trLater("Shadows"),
     trLater("How far the sun and the moon cast shadows.\nCost: medium, higher while you move."),
     {trLater("Off"), trLater("Near"), trLater("Far"), trLater("To the horizon")}},
    {"soft-shadows",
     trLater("Soft shadows"),
     trLater("Shadows get softer with the distance to what casts them.\nCost: low."),
     {}},
    {"samples",
     trLater("Anti-aliasing"),
     trLater("Samples per pixel (MSAA).\nCost: high; four samples at least double the frame time."),
     {trLater("Off"), trLater("2 samples"), trLater("4 samples"), trLater("8 samples")}},
    {"light",
     trLater("Light"),
     trLater("Steps from block to block, or smooth transitions.\nCost: low."),
     {trLater("Classic"), trLater("Smooth")}},
    {"ssao",
     trLater("Ambient occlusion"),
     trLater("Corners and gaps are a little darker (SSAO).\nCost: a fourteenth of the frame time."),
     {trLater("Off"), trLater("On"), trLater("Coarse")}},
    {"water",
     trLater("Water"),
     trLater("Full: reflected shores, waves, foam.\nCost: medium where water is in view."),
     {trLater("Plain"), trLater("Full")}},
    {"clouds", trLater("Clouds"), trLater("Clouds in the sky and their shadows.\nCost: medium."), {}},
    {"god-rays",
     trLater("Sun rays"),
     trLater("Rays of light between things in front of the sun.\nCost: low."),
     {}},
    {"distance-fog", trLater("Distance fog"), trLater("Far land fades into the sky.\nCost: none."), {}},
    {"animation", trLater("Moving plants"), trLater("Plants, leaves and water move.\nCost: low."), {}},
    {"depth-of-field", trLater("Depth of field"), trLater("Distant things are blurred.\nCost: low."), {}},
};

const render::GraphicsRow* rowNamed(std::string_view name) {
    const auto found = std::ranges::find(render::graphicsTable(), name, &render::GraphicsRow::name);
    return found == render::graphicsTable().end() ? nullptr : &*found;
}

void drawPlainRow(const PlainRow& plain, render::GraphicsSettings& graphics, const Texts& tr) {
    const render::GraphicsRow* row = rowNamed(plain.name);
    if (!row) return;
    int value = row->get(graphics);
    bool isChanged = false;
    if (plain.words[0] == nullptr) {
        bool isOn = value == 1;
        isChanged = ui::checkbox(tr(plain.label), &isOn);
        value = isOn ? 1 : 0;
    } else {
        const auto count = static_cast<int>(row->valueNames.size());
        const bool isKnown = value >= 0 && value < count;
        if (ui::beginCombo(tr(plain.label),
                           isKnown ? tr(plain.words[static_cast<std::size_t>(value)]) : tr("Other"))) {
            for (int k = 0; k < count; ++k) {
                if (!ui::selectable(tr(plain.words[static_cast<std::size_t>(k)]), k == value)) continue;
                value = k;
                isChanged = true;
            }
            ImGui::EndCombo();
        }
    }
    tooltipFor(tr(plain.help));
    if (isChanged) row->set(graphics, value);
}

struct Quality {
    const char *preset, *label, *help;
};
constexpr Quality kQualities[] = {
    {"auto", trLater("Auto"), trLater("High on a graphics card, low without one.")},
    {"low", trLater("Low"),
     trLater("For machines without a graphics card. No distant shadows, one sample per pixel.")},
    {"medium", trLater("Medium"),
     trLater("Anti-aliasing, clouds, sun rays.\nA frame takes 3.8 times as long as with low.")},
    {"high", trLater("High"),
     trLater("Also ambient occlusion.\nA frame takes 4.5 times as long as with low.")},
    {"ultra", trLater("Ultra"),
     trLater(
         "Finer shadows and distant land.\nA frame takes a little longer than with high, and more memory.")},
};

void drawQuality(PlaySettings& s, bool isSoftwareRenderer, const Texts& tr) {
    const float gap = ImGui::GetStyle().ItemSpacing.x, count = static_cast<float>(std::size(kQualities));
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    for (const Quality& quality : kQualities) {
        if (&quality != kQualities) ImGui::SameLine();
        if (tabButton(tr(quality.label), s.preset == quality.preset, width)) {
            s.preset = quality.preset;
            s.graphics = render::withPreset(s.graphics, s.preset, isSoftwareRenderer);
        }
        tooltipFor(tr(quality.help));
    }
}

}  // namespace

void drawGraphicsPage(PlaySettings& s, bool isSoftwareRenderer, const Texts& tr) {
    heading(tr("Quality"));
    drawQuality(s, isSoftwareRenderer, tr);
    heading(tr("View"));
    ui::slider(tr("View distance"), &s.graphics.viewDistance, 2, 64, tr("%d chunks"));
    tooltipFor(
        tr("In chunks of 16 blocks, which are shown in full.\nCost: high; memory grows with the square."));
    ui::slider(tr("Field of view"), &s.fieldOfView, 40, 110, tr("%.0f degrees"));
    tooltipFor(tr("Vertical.\nCost: a little higher if it is wider."));
    ui::checkbox(tr("Full screen"), &s.fullScreen);
    heading(tr("Details"));
    for (const PlainRow& row : kRows) drawPlainRow(row, s.graphics, tr);
}

void drawWorldPage(PlaySettings& s, game::DayClock* day, const Texts& tr) {
    constexpr std::array<const char*, 4> kMovements = {trLater("Fly fast, through blocks"),
                                                       trLater("Fly slowly, through blocks"),
                                                       trLater("Fly, with collisions"), trLater("Walk")};
    heading(tr("Time"));
    if (day) {
        float time = static_cast<float>(day->timeDay) * 24;
        char text[16];
        std::snprintf(text, sizeof text, "%02d:%02d", static_cast<int>(time) % 24,
                      static_cast<int>(time * 60) % 60);
        if (ui::slider(tr("Time of day"), &time, 0, 24, text))
            day->timeDay = std::min(double{time} / 24, 0.99999);
        ui::checkbox(tr("Time runs"), &day->isRunning);
    }
    float minutes = static_cast<float>(s.dayMinutes);
    if (ui::slider(tr("Minutes per day"), &minutes, 0.5f, 60, "%.1f")) s.dayMinutes = double{minutes};
    tooltipFor(tr("Length of a day of the world."));
    if (!day) {
        dimText(tr("Each world has its own time and movement mode:\nplay it to change them."));
        return;
    }
    heading(tr("Movement"));
    const auto chosen = static_cast<std::size_t>(s.movement);
    if (!ui::beginCombo(tr("Movement mode"), tr(kMovements[chosen]))) return;
    for (std::size_t k = 0; k < kMovements.size(); ++k)
        if (ui::selectable(tr(kMovements[k]), k == chosen)) s.movement = static_cast<game::Movement>(k);
    ImGui::EndCombo();
}

static void drawLanguageAndSound(PlaySettings& s, const Texts& tr) {
    // Each language in its own name, so that everyone finds theirs.
    const std::array<std::pair<const char*, const char*>, 4> languages = {
        {{"auto", tr("System language")}, {"en", "English"}, {"cs", "Čeština"}, {"de", "Deutsch"}}};
    heading(tr("Language and sound"));
    const auto chosen = std::ranges::find(languages, s.language, [](const auto& row) { return row.first; });
    const char* const shown = chosen != languages.end() ? chosen->second : s.language.c_str();
    if (ui::beginCombo((tr("Language") + std::string("###language")).c_str(), shown)) {
        for (const auto& [code, name] : languages)
            if (ui::selectable(name, s.language == code)) s.language = code;
        ImGui::EndCombo();
    }
    float percent = s.soundVolume * 100;
    if (ui::slider(tr("Sound volume"), &percent, 0, 100, "%.0f %%")) s.soundVolume = percent / 100;
}

void drawGeneralPage(PlaySettings& s, const Texts& tr) {
    constexpr std::array<std::pair<const char*, float>, 6> kSizes = {{{"75 %", 0.75f},
                                                                      {"100 %", 1.0f},
                                                                      {"125 %", 1.25f},
                                                                      {"150 %", 1.5f},
                                                                      {"175 %", 1.75f},
                                                                      {"200 %", 2.0f}}};
    drawLanguageAndSound(s, tr);
    heading(tr("Accessibility"));
    char shown[16];
    std::snprintf(shown, sizeof shown, "%.0f %%", double{s.textSize} * 100);
    if (ui::beginCombo(tr("Text size"), shown)) {
        for (const auto& [label, size] : kSizes)
            if (ui::selectable(label, s.textSize == size)) s.textSize = size;
        ImGui::EndCombo();
    }
    tooltipFor(tr("Size of all texts and menus."));
    ui::checkbox(tr("High contrast"), &s.highContrast);
    tooltipFor(
        tr("The targeted block gets thick lines in black, white and orange, for color-blind players."));
    ui::checkbox(tr("Reduced motion"), &s.reducedMotion);
    tooltipFor(tr("The world behind the title stands still."));
}

}  // namespace terrane::app
