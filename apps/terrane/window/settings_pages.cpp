// The pages of the settings dialog that show values of the settings.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/settings_dialog.h"
#include "apps/terrane/window/ui_style.h"

namespace terrane::app {
namespace {

constexpr ImGuiSliderFlags kClamped = ImGuiSliderFlags_AlwaysClamp;

// A row of the graphics table in words. Costs are those of docs/rendering.md, "What a preset costs".
struct PlainRow {
    const char* name;  // of the row
    const char* label;
    const char* help;  // what one sees, and what it costs
    std::array<const char*, 7> words;
};

constexpr PlainRow kRows[] = {
    {"horizon",
     "Land beyond",
     "How far land goes on beyond what is shown in full.\nCost: some; memory grows with it.",
     {"None", "2 km", "4 km", "8 km", "16 km", "33 km", "65 km"}},
    {"shadows",
     "Shadows",
     "How far the sun and the moon cast shadows.\nCost: some, more while one moves.",
     {"Off", "Near", "Far", "To the horizon"}},
    {"soft-shadows", "Soft shadows", "Shadows blur with the distance of what casts them.\nCost: little.", {}},
    {"samples",
     "Smooth edges",
     "Samples of each pixel (MSAA).\nCost: high; four samples double a frame or more.",
     {"Off", "2 samples", "4 samples", "8 samples"}},
    {"light", "Light", "Steps from block to block, or soft corners.\nCost: little.", {"Classic", "Smooth"}},
    {"ssao",
     "Shade in corners",
     "Corners and gaps are a little darker.\nCost: a fourteenth of a frame.",
     {"Off", "On", "Rough"}},
    {"water",
     "Water",
     "Full: shores mirrored, waves, foam.\nCost: some where water is in view.",
     {"Plain", "Full"}},
    {"clouds", "Clouds", "Clouds in the sky and their shadows.\nCost: some.", {}},
    {"god-rays", "Rays of the sun", "Rays between what stands before the sun.\nCost: little.", {}},
    {"distance-fog", "Distance fog", "Far land fades into the sky.\nCost: none.", {}},
    {"animation", "Moving plants", "Plants, leaves and water move.\nCost: little.", {}},
    {"depth-of-field", "Blur far away", "What is far away is blurred.\nCost: little.", {}},
};

const render::GraphicsRow* rowNamed(std::string_view name) {
    const auto found = std::ranges::find(render::graphicsTable(), name, &render::GraphicsRow::name);
    return found == render::graphicsTable().end() ? nullptr : &*found;
}

void drawPlainRow(const PlainRow& plain, render::GraphicsSettings& graphics) {
    const render::GraphicsRow* row = rowNamed(plain.name);
    if (!row) return;
    int value = row->get(graphics);
    bool isChanged = false;
    if (plain.words[0] == nullptr) {
        bool isOn = value == 1;
        isChanged = ImGui::Checkbox(plain.label, &isOn);
        value = isOn ? 1 : 0;
    } else {
        const auto count = static_cast<int>(row->valueNames.size());
        const bool isKnown = value >= 0 && value < count;
        if (ImGui::BeginCombo(plain.label,
                              isKnown ? plain.words[static_cast<std::size_t>(value)] : "Other")) {
            for (int k = 0; k < count; ++k) {
                if (!ImGui::Selectable(plain.words[static_cast<std::size_t>(k)], k == value)) continue;
                value = k;
                isChanged = true;
            }
            ImGui::EndCombo();
        }
    }
    tooltipFor(plain.help);
    if (isChanged) row->set(graphics, value);
}

struct Quality {
    const char *preset, *label, *help;
};
constexpr Quality kQualities[] = {
    {"auto", "Auto", "High on a graphics card, low without one."},
    {"low", "Low", "For machines without a graphics card. No shadows of far things, one sample a pixel."},
    {"medium", "Medium",
     "Smooth edges, clouds, rays of the sun.\nA frame takes 3.8 times as long as with low."},
    {"high", "High", "Also shade in corners.\nA frame takes 4.5 times as long as with low."},
    {"ultra", "Ultra",
     "Finer shadows and far land.\nA frame takes a little longer than with high, and memory."},
};

void drawQuality(PlaySettings& s, bool isSoftwareRenderer) {
    const float gap = ImGui::GetStyle().ItemSpacing.x, count = static_cast<float>(std::size(kQualities));
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    for (const Quality& quality : kQualities) {
        if (&quality != kQualities) ImGui::SameLine();
        if (tabButton(quality.label, s.preset == quality.preset, width)) {
            s.preset = quality.preset;
            s.graphics = render::withPreset(s.graphics, s.preset, isSoftwareRenderer);
        }
        tooltipFor(quality.help);
    }
}

}  // namespace

void drawGraphicsPage(PlaySettings& s, bool isSoftwareRenderer) {
    heading("Quality");
    drawQuality(s, isSoftwareRenderer);
    heading("View");
    ImGui::SliderInt("View distance", &s.graphics.viewDistance, 2, 64, "%d chunks", kClamped);
    tooltipFor("Chunks of 16 blocks that are shown in full.\nCost: high; memory grows with its square.");
    ImGui::SliderFloat("Field of view", &s.fieldOfView, 40, 110, "%.0f degrees", kClamped);
    tooltipFor("From below to above.\nCost: little more where more is in view.");
    ImGui::Checkbox("Full screen", &s.fullScreen);
    heading("Details");
    for (const PlainRow& row : kRows) drawPlainRow(row, s.graphics);
}

void drawWorldPage(PlaySettings& s, game::DayClock* day) {
    constexpr std::array<const char*, 4> kMovements = {"Fast, through everything", "Slow, through everything",
                                                       "Flying, not through blocks", "On foot"};
    heading("Time");
    if (day) {
        float time = static_cast<float>(day->timeDay) * 24;
        char text[16];
        std::snprintf(text, sizeof text, "%02d:%02d", static_cast<int>(time) % 24,
                      static_cast<int>(time * 60) % 60);
        if (ImGui::SliderFloat("Time of day", &time, 0, 24, text, kClamped))
            day->timeDay = std::min(double{time} / 24, 0.99999);
        ImGui::Checkbox("Time passes", &day->isRunning);
    }
    float minutes = static_cast<float>(s.dayMinutes);
    if (ImGui::SliderFloat("Minutes a day", &minutes, 0.5f, 60, "%.1f", kClamped))
        s.dayMinutes = double{minutes};
    tooltipFor("How long a day of the world takes.");
    if (!day) {
        dimText("A world keeps its own time and way to move:\nplay it to change them.");
        return;
    }
    heading("Movement");
    const auto chosen = static_cast<std::size_t>(s.movement);
    if (!ImGui::BeginCombo("How one moves", kMovements[chosen])) return;
    for (std::size_t k = 0; k < kMovements.size(); ++k)
        if (ImGui::Selectable(kMovements[k], k == chosen)) s.movement = static_cast<game::Movement>(k);
    ImGui::EndCombo();
}

void drawAccessibilityPage(PlaySettings& s) {
    constexpr std::array<std::pair<const char*, float>, 6> kSizes = {{{"75 %", 0.75f},
                                                                      {"100 %", 1.0f},
                                                                      {"125 %", 1.25f},
                                                                      {"150 %", 1.5f},
                                                                      {"175 %", 1.75f},
                                                                      {"200 %", 2.0f}}};
    heading("Accessibility");
    char shown[16];
    std::snprintf(shown, sizeof shown, "%.0f %%", double{s.textSize} * 100);
    if (ImGui::BeginCombo("Text size", shown)) {
        for (const auto& [label, size] : kSizes)
            if (ImGui::Selectable(label, s.textSize == size)) s.textSize = size;
        ImGui::EndCombo();
    }
    tooltipFor("Of all texts and menus.");
    ImGui::Checkbox("High contrast", &s.highContrast);
    tooltipFor(
        "The block that is looked at gets thick lines in black, white and orange, which all eyes tell "
        "apart.");
    ImGui::Checkbox("Reduced motion", &s.reducedMotion);
    tooltipFor("The world behind the title stands still.");
}

}  // namespace terrane::app
