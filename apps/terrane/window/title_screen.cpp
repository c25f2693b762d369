#include "apps/terrane/window/title_screen.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/ui_style.h"
#include "terrane/base/log.h"
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
    while (!quits_ && !choice_ && !parts_.window.shouldClose() && !parts_.signals.stopAsked()) {
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
    choice_ = ChosenWorld{world.path, {}, {}};
}

void TitleScreen::create() {
    auto world = worldOf(form_, parts_.folder);
    if (!world) return showMessage(world.error().message);
    choice_ = std::move(*world);
}

}  // namespace terrane::app
