// The title's dialogs: a new world, names, a copy, the question before a world is deleted, messages.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <random>

#include "apps/terrane/window/title_screen.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {
namespace {

float halfWidth() {
    return (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
}

}  // namespace

void TitleScreen::drawNewWorld(const Screen& screen) {
    const float scale = uiScale(), margin = 12 * scale, row = 44 * scale;
    const bool isWide = screen.width > 460 * scale;
    const float most = std::min(screen.height - 2 * margin - row, isWide ? 300 * scale : 160 * scale);
    const float formWidth = 280 * scale;
    const ImVec2 size(isWide ? std::min(formWidth + most + 3 * margin, screen.width - 2 * margin)
                             : screen.width - 2 * margin,
                      isWide ? most + row : screen.height - 2 * margin);
    beginMenu({tr_("New world"), {screen.width / 2, screen.height / 2}, size});
    const float inside = ImGui::GetContentRegionAvail().y;
    const float side = isWide ? std::min(inside, ImGui::GetContentRegionAvail().x - formWidth) : most;
    ImGui::BeginChild(
        "form",
        {isWide ? ImGui::GetContentRegionAvail().x - side - margin : 0, isWide ? 0 : inside - side - margin},
        false, ImGuiWindowFlags_NavFlattened);
    drawForm();
    ImGui::EndChild();
    if (isWide) ImGui::SameLine(0, margin);
    drawMap(side);
    ImGui::End();
}

void TitleScreen::drawForm() {
    dimText(tr_("Name"));
    ImGui::PushItemWidth(-1);
    editText("##name", form_.name);
    dimText(tr_("Seed (a number or any text)"));
    const auto seed = seedOf(form_);
    const float button = 64 * uiScale();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
    editText("##seed", form_.seed);
    ImGui::SameLine();
    if (ui::button(tr_("Random"), {button, 0})) {
        form_.seed.clear();
        form_.randomSeed = std::random_device()();
    }
    if (seed) {
        dimText(fmt::format(fmt::runtime(tr_("is {}")), seed->seed));
    } else {
        warningText(seed.error().message);
    }
    dimText(tr_("Generator"));
    if (ui::beginCombo("##generator", form_.generator.c_str())) {
        for (const std::string& name : gen::namesOf(parts_.content.generators))
            if (ui::selectable(name.c_str(), name == form_.generator)) form_.generator = name;
        ImGui::EndCombo();
    }
    ImGui::PopItemWidth();
    ImGui::Spacing();
    const float width = halfWidth();
    if (menuButton(tr_("Create"), width)) create();
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (menuButton(tr_("Back"), width)) back();
}

// North is up; the spawn in the middle is marked.
void TitleScreen::drawMap(float side) {
    if (const auto seed = seedOf(form_)) map_.show({form_.generator, seed->seed});
    const ImVec2 at = ImGui::GetCursorScreenPos(), end(at.x + side, at.y + side);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float scale = uiScale();
    draw.AddRectFilled(at, end, IM_COL32(30, 34, 40, 255), 4 * scale);
    if (const unsigned image = map_.image())
        draw.AddImageRounded(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image)), at, end,
                             {0, 0}, {1, 1}, IM_COL32_WHITE, 4 * scale);
    const ImVec2 middle(at.x + side / 2, at.y + side / 2);
    draw.AddCircleFilled(middle, 4 * scale, IM_COL32(0, 0, 0, 160));
    draw.AddCircleFilled(middle, 2.5f * scale, ImGui::GetColorU32(colors::kAccent));
    const char* text = !map_.problem().empty() ? map_.problem().c_str()
                       : map_.isComplete()     ? "4 km"
                                               : tr_("drawing...");
    draw.AddText({at.x + 7 * scale, end.y - ImGui::GetFontSize() - 5 * scale}, IM_COL32(0, 0, 0, 200), text);
    draw.AddText({at.x + 6 * scale, end.y - ImGui::GetFontSize() - 6 * scale}, IM_COL32_WHITE, text);
    ImGui::Dummy({side, side});
}

void TitleScreen::drawName(const Screen& screen) {
    const bool isRename = pages_.back() == Page::Rename;
    beginMenu({isRename ? tr_("Rename world") : tr_("Copy world"),
               {screen.width / 2, screen.height / 2},
               {std::min(340 * uiScale(), screen.width - 20), 0}});
    dimText(isRename ? tr_("New name") : tr_("Name of the copy"));
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::PushItemWidth(-1);
    bool isDone = editText("##name", nameText_,
                           ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopItemWidth();
    const float width = halfWidth();
    isDone = menuButton(isRename ? tr_("Rename") : tr_("Copy"), width) || isDone;
    ImGui::SameLine();
    if (menuButton(tr_("Cancel"), width)) return ImGui::End(), back();
    ImGui::End();
    if (isDone) changeName();
}

// Changes the chosen world. The background is closed meanwhile, since an open world cannot be changed.
template <class Change>
void TitleScreen::changeChosen(Change change) {
    background_.reset();
    const base::Result<void> done = change();
    openBackground();
    if (!done) showMessage(done.error().message);
}

void TitleScreen::changeName() {
    const bool isRename = pages_.back() == Page::Rename;
    if (auto good = store::checkWorldName(nameText_); !good) return showMessage(good.error().message);
    pages_.pop_back();
    if (isRename) return changeChosen([&] { return shelf_.rename(nameText_); });
    shelf_.startCopy(nameText_);
    open(Page::Copying);
}

void TitleScreen::drawCopying(const Screen& screen) {
    beginMenu({tr_("Copying"), {screen.width / 2, screen.height / 2}, {300 * uiScale(), 0}});
    ImGui::ProgressBar(shelf_.copied(), {-1, 14 * uiScale()}, "");
    if (menuButton(tr_("Cancel"))) shelf_.cancelCopy();
    ImGui::End();
    const auto done = shelf_.takeCopy();
    if (!done) return;
    pages_.pop_back();
    if (!*done) showMessage(done->error().message);
}

void TitleScreen::drawDelete(const Screen& screen) {
    const store::WorldEntry* world = shelf_.chosen();
    if (!world) return back();
    const std::string name = world->name, text = describe(*world);
    beginMenu({tr_("Delete world"),
               {screen.width / 2, screen.height / 2},
               {std::min(360 * uiScale(), screen.width - 20), 0}});
    ImGui::TextWrapped(tr_("Delete \"%s\"? This cannot be undone."), name.c_str());
    dimText(text);
    ImGui::Spacing();
    const float width = halfWidth();
    const bool isKept = menuButton(tr_("Keep it"), width);
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.55f, 0.16f, 0.12f, 1));
    const bool isDeleted = menuButton(tr_("Delete"), width);
    ImGui::PopStyleColor();
    ImGui::End();
    if (isKept) return back();
    if (!isDeleted) return;
    pages_.pop_back();
    changeChosen([&] { return shelf_.remove(); });
}

void TitleScreen::drawMessage(const Screen& screen) {
    beginMenu({tr_("Message"),
               {screen.width / 2, screen.height / 2},
               {std::min(420 * uiScale(), screen.width - 20), 0}});
    warningText(message_);
    ImGui::Spacing();
    const bool isRead = menuButton("OK");
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::End();
    if (isRead) back();
}

}  // namespace terrane::app
