// The title's main page, list of worlds, and page to join a server.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <random>

#include "apps/terrane/window/thumbnail.h"
#include "apps/terrane/window/title_screen.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {

void TitleScreen::drawPage(const Screen& screen) {
    switch (pages_.back()) {
        case Page::Main:
            return drawMain(screen);
        case Page::Worlds:
            return drawWorlds(screen);
        case Page::NewWorld:
            return drawNewWorld(screen);
        case Page::Join:
            return drawJoin(screen);
        case Page::Rename:
        case Page::Copy:
            return drawName(screen);
        case Page::Copying:
            return drawCopying(screen);
        case Page::Delete:
            return drawDelete(screen);
        case Page::Settings:
            if (dialog_.draw(settings_, {screen, tr_, parts_.screen.device.software, nullptr})) back();
            return;
        case Page::Message:
            return drawMessage(screen);
    }
}

void TitleScreen::drawMain(const Screen& screen) {
    const float scale = uiScale(), width = std::min(260 * scale, screen.width - 20 * scale);
    const float block = std::max(2.0f, std::floor(std::min(screen.width * 0.6f / kLogoBlocksWide,
                                                           screen.height * 0.2f / kLogoBlocksHigh)));
    const ImVec2 logo((screen.width - block * kLogoBlocksWide) / 2, screen.height * 0.1f);
    drawLogo(*ImGui::GetBackgroundDrawList(), logo, block);
    const float below = logo.y + block * (kLogoBlocksHigh + 1);
    beginMenu({"title", {screen.width / 2, below + (screen.height - below) / 2}, {width, 0}, false});
    const store::WorldEntry* last = shelf_.last();
    const bool isFirst = ImGui::IsWindowAppearing();
    if (last) {
        if (menuButton(fmt::format(fmt::runtime(tr_("Continue {}")), last->name).c_str())) play(*last);
        if (isFirst) ImGui::SetItemDefaultFocus();
        if (menuButton(fmt::format(fmt::runtime(tr_("Worlds ({})")), shelf_.worlds().size()).c_str()))
            open(Page::Worlds);
    } else if (!shelf_.worlds().empty() && menuButton(tr_("Worlds"))) {
        open(Page::Worlds);
    }
    if (menuButton(tr_("New world"))) {
        form_ = newForm(parts_.folder, std::random_device()());
        open(Page::NewWorld);
    }
    if (!last && isFirst) ImGui::SetItemDefaultFocus();
    if (menuButton(tr_("Join a server"))) {
        join_.open();
        open(Page::Join);
    }
    if (menuButton(tr_("Settings"))) {
        dialog_.open();
        open(Page::Settings);
    }
    if (menuButton(tr_("Quit (Q)"))) quits_ = true;
    ImGui::End();
    const std::string version = fmt::format("Terrane {}", TERRANE_VERSION);
    ImGui::GetBackgroundDrawList()->AddText({8 * scale, screen.height - ImGui::GetFontSize() - 6 * scale},
                                            IM_COL32(255, 255, 255, 170), version.c_str());
}

void TitleScreen::drawJoin(const Screen& screen) {
    const JoinDialog::Outcome outcome = join_.draw(screen, tr_);
    if (outcome == JoinDialog::Outcome::Back) back();
    if (outcome == JoinDialog::Outcome::Join) choice_ = join_.options();
}

void TitleScreen::drawWorlds(const Screen& screen) {
    const float scale = uiScale(), margin = 12 * scale;
    beginMenu({tr_("Worlds"),
               {screen.width / 2, screen.height / 2},
               {std::min(640 * scale, screen.width - 2 * margin),
                std::min(460 * scale, screen.height - 2 * margin)}});
    const float footer = 30 * scale + ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("list", {0, -footer}, false, ImGuiWindowFlags_NavFlattened);
    for (std::size_t k = 0; k < shelf_.worlds().size(); ++k) drawRow(k);
    if (shelf_.worlds().empty()) dimText(tr_("There is no world yet."));
    ImGui::EndChild();
    drawWorldButtons();
    ImGui::End();
}

void TitleScreen::drawRow(std::size_t index) {
    const store::WorldEntry& world = shelf_.worlds()[index];
    const bool isChosen = &world == shelf_.chosen();
    const float scale = uiScale(), height = 54 * scale, gap = 4 * scale;
    const float width = height * kThumbnailWidth / kThumbnailHeight;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(index));
    const bool isPressed = ui::selectable("##world", isChosen, world.name,
                                          ImGuiSelectableFlags_AllowDoubleClick, {0, height + 2 * gap});
    if (isChosen && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    if (ImGui::IsItemFocused() || isPressed) shelf_.choose(index);
    const bool isByMouse = ImGui::IsMouseClicked(0) || ImGui::IsMouseReleased(0);
    if (isPressed && (!isByMouse || ImGui::IsMouseDoubleClicked(0))) play(world);
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 low(at.x + gap, at.y + gap), high(low.x + width, low.y + height);
    if (const unsigned picture = shelf_.picture(world)) {
        draw.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture)), low, high,
                             {0, 0}, {1, 1}, IM_COL32_WHITE, 3 * scale);
    } else {
        draw.AddRectFilled(low, high, IM_COL32(50, 56, 64, 255), 3 * scale);
    }
    const float left = high.x + 10 * scale, line = ImGui::GetTextLineHeightWithSpacing();
    draw.AddText({left, low.y + height / 2 - line}, ImGui::GetColorU32(colors::kText), world.name.c_str());
    draw.AddText({left, low.y + height / 2 + 2 * scale},
                 ImGui::GetColorU32(world.problem.empty() ? colors::kDim : colors::kWarning),
                 describe(world).c_str());
}

void TitleScreen::drawWorldButtons() {
    constexpr float kCount = 6;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap * (kCount - 1)) / kCount;
    const store::WorldEntry* chosen = shelf_.chosen();
    const bool isThere = chosen != nullptr, isGood = isThere && chosen->problem.empty();
    const bool isFree = isThere && chosen->inUse.empty();
    if (menuButton(tr_("Play"), width, isGood && isFree)) play(*chosen);
    ImGui::SameLine();
    if (menuButton(tr_("New"), width)) {
        form_ = newForm(parts_.folder, std::random_device()());
        open(Page::NewWorld);
    }
    if (!isThere && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (menuButton(tr_("Rename"), width, isFree)) {
        nameText_ = chosen->name;
        open(Page::Rename);
    }
    ImGui::SameLine();
    if (menuButton(tr_("Copy"), width, isGood)) {
        nameText_ = store::freeWorldName(parts_.folder, chosen->name + " copy");
        open(Page::Copy);
    }
    ImGui::SameLine();
    if (menuButton(tr_("Delete"), width, isFree)) open(Page::Delete);
    ImGui::SameLine();
    if (menuButton(tr_("Back"), width)) back();
}

}  // namespace terrane::app
