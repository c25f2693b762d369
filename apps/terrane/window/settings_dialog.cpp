#include "apps/terrane/window/settings_dialog.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/key_help.h"
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

}  // namespace terrane::app
