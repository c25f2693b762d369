#include "apps/terrane/window/title/title_screen.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <random>

#include "apps/terrane/window/game/pictures.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/base/log.h"
#include "terrane/base/names.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/framebuffer.h"

namespace terrane::app {

TitleScreen::TitleScreen(const Parts& parts, PlaySettings& settings, std::string message)
    : parts_(parts),
      settings_(settings),
      language_(settings.language),
      tr_(textsOf(settings.language)),
      imgui_(parts.window),
      shelf_(parts.folder, *parts.content.blocks),
      map_(parts.content),
      join_(serverListFile(parts.folder)) {
    parts_.window.setCursorCaptured(false);
    if (!message.empty()) showMessage(std::move(message));
    openBackground();
}

void TitleScreen::openBackground() {
    const store::WorldEntry* last = shelf_.last();
    auto opened = TitleBackground::open(parts_.options, parts_.screen, last ? last->path : "");
    background_.reset();
    if (opened) background_.emplace(std::move(*opened));
    if (!opened) base::logInfo("nothing is shown behind the title: {}", opened.error().message);
}

base::Result<std::optional<TitleChoice>> TitleScreen::run() {
    double last = parts_.window.timeSeconds();
    while (!quits_ && !choice_ && !parts_.window.shouldClose() && !parts_.signals.stopRequested()) {
        parts_.window.pollEvents();
        handleEvents();
        const double now = parts_.window.timeSeconds(), seconds = now - last;
        last = now;
        parts_.window.setFullScreen(settings_.fullScreen);
        TERRANE_TRY(drawFrame(seconds));
    }
    if (choice_ && std::holds_alternative<ChosenWorld>(*choice_)) drawOpening();
    return std::exchange(choice_, std::nullopt);
}

base::Result<void> TitleScreen::drawFrame(double seconds) {
    const glm::ivec2 size = parts_.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return {};  // minimised
    if (!background_) {
        gpu::clearWindow({0.12f, 0.15f, 0.18f});
    } else
        TERRANE_TRY(background_->draw(size, seconds, settings_.reducedMotion));
    if (settings_.language != language_) tr_ = textsOf(language_ = settings_.language);
    imgui_.setTextSize(settings_.textSize);
    imgui_.beginFrame(false, true);
    drawPage({imgui_.size().x, imgui_.size().y});
    imgui_.endFrame();
    parts_.window.swapBuffers();
    return {};
}

// Draws the title once more while the world opens.
void TitleScreen::drawOpening() {
    const glm::ivec2 size = parts_.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return;
    if (background_) (void)background_->draw(size, 0, true);
    imgui_.beginFrame(false, true);
    beginMenu({"opening", {imgui_.size().x / 2, imgui_.size().y / 2}, {0, 0}, false});
    ImGui::Text(tr_("Opening %s"), std::get<ChosenWorld>(*choice_).file.stem().c_str());
    ImGui::End();
    imgui_.endFrame();
    parts_.window.swapBuffers();
}

void TitleScreen::handleEvents() {
    for (const InputEvent& event : parts_.window.events())
        if (event.type == InputEvent::Type::KeyPress) onKey(event.key);
    onPad();
}

void TitleScreen::onKey(Key key) {
    if (pages_.back() == Page::Settings && dialog_.takeKey(key, settings_, tr_)) return;
    if (imgui_.takesKeys()) return;  // Escape ends text input
    if (key == Key::Escape) return back();
    if (key == Key::Q && pages_.back() == Page::Main) quits_ = true;
    if (settings_.keys.actionOf(key) == Action::FullScreen) settings_.fullScreen = !settings_.fullScreen;
}

void TitleScreen::onPad() {
    pad_.read(parts_.window.gamepad());
    const bool isTaken = pages_.back() == Page::Settings && dialog_.takePad(pad_, settings_, tr_);
    imgui_.setPadIgnored(isTaken);
    if (isTaken) return;
    if (pad_.isPressed(&Gamepad::east)) back();
    if (pages_.back() != Page::Settings) return;
    if (pad_.isPressed(&Gamepad::leftBumper)) dialog_.turnPage(-1);
    if (pad_.isPressed(&Gamepad::rightBumper)) dialog_.turnPage(1);
}

// Closes one thing per press; the main page stays.
void TitleScreen::back() {
    if (imgui_.hasPopup()) return imgui_.endTyping();
    if (pages_.back() == Page::Copying) return shelf_.cancelCopy();
    if (pages_.size() > 1) pages_.pop_back();
}

void TitleScreen::open(Page page) {
    pages_.push_back(page);
}

void TitleScreen::showMessage(std::string text) {
    message_ = std::move(text);
    open(Page::Message);
}

void TitleScreen::play(const store::WorldEntry& world) {
    if (!world.problem.empty()) return showMessage(world.name + ": " + world.problem);
    if (!world.inUse.empty()) return showMessage(world.name + ": " + world.inUse);
    choice_ = ChosenWorld{world.path, {}, {}, {}};
}

void TitleScreen::create() {
    auto world = worldOf(form_, parts_.folder);
    if (!world) return showMessage(world.error().message);
    choice_ = std::move(*world);
}

// The title's main page, list of worlds, and page to join a server.

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
        form_ = newForm(parts_.folder, std::random_device()(), parts_.content);
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
        form_ = newForm(parts_.folder, std::random_device()(), parts_.content);
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
        nameText_ = store::unusedWorldName(parts_.folder, chosen->name + " copy");
        open(Page::Copy);
    }
    ImGui::SameLine();
    if (menuButton(tr_("Delete"), width, isFree)) open(Page::Delete);
    ImGui::SameLine();
    if (menuButton(tr_("Back"), width)) back();
}

// The title's dialogs: a new world, names, a copy, the question before a world is deleted, messages.

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
    // In a narrow window the map is below the form, which has most of the height.
    const float side =
        isWide ? std::min(inside, ImGui::GetContentRegionAvail().x - formWidth) : std::min(most, inside / 3);
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
        dimText(seedNote(form_, *seed, tr_));  // an empty line too, so that nothing moves
    } else {
        warningText(seed.error().message);
    }
    dimText(tr_("Generator"));
    if (ui::beginCombo("##generator", form_.generator.c_str())) {
        for (const std::string& name : gen::namesOf(parts_.content.generators))
            if (ui::selectable(name.c_str(), name == form_.generator))
                chooseGenerator(form_, name, parts_.content);
        ImGui::EndCombo();
    }
    drawHeights();
    ui::checkbox(tr_("Survival"), &form_.isSurvival);
    ImGui::PopItemWidth();
    ImGui::Spacing();
    const float width = halfWidth();
    if (menuButton(tr_("Create"), width)) create();
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (menuButton(tr_("Back"), width)) back();
}

// Empty fields show the heights of the generator.
void TitleScreen::drawHeights() {
    dimText(tr_("Bottom and top (multiples of 16)"));
    const float width = halfWidth();
    ImGui::SetNextItemWidth(width);
    editText("##bottom", form_.bottom, 0, std::to_string(form_.declared.bottom).c_str());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    editText("##top", form_.top, 0, std::to_string(form_.declared.top).c_str());
    if (const auto heights = heightsOf(form_)) {
        dimText(fmt::format(fmt::runtime(tr_("Layers {} to {}")), heights->bottom, heights->top - 1));
    } else {
        warningText(heights.error().message);
    }
}

// North is up; the spawn in the middle is marked.
void TitleScreen::drawMap(float side) {
    const auto seed = seedOf(form_);
    const auto heights = heightsOf(form_);
    if (seed && heights) map_.show({form_.generator, seed->seed, *heights});
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
    nameText_ = base::normalizedName(nameText_);
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
