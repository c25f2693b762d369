#include "tests/window/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <utility>

#include "apps/terrane/commands/commands.h"

namespace terrane::app {
namespace {

// A guard against hangs, far above what a slow machine needs to load a world.
constexpr int kMostFrames = 20000;

// Frames until widgets show the effect of an event, and a text field that ended takes no more keys.
constexpr int kSettling = 2;

std::optional<Key> keyOf(char typed) {
    if (typed >= 'a' && typed <= 'z') return static_cast<Key>(static_cast<int>(Key::A) + typed - 'a');
    if (typed >= '0' && typed <= '9') return static_cast<Key>(static_cast<int>(Key::Digit0) + typed - '0');
    if (typed == ' ') return Key::Space;
    return std::nullopt;
}

// "a###b" has the names "a", "b" and itself.
bool isNamed(std::string_view label, std::string_view name) {
    const std::size_t end = label.find("##");
    if (label == name || label.substr(0, end) == name) return true;
    if (end == label.npos) return false;
    const std::size_t id = label.find_first_not_of('#', end);
    return id != label.npos && label.substr(id) == name;
}

bool isVisible(const Widget& widget, ImVec2 at) {
    return at.x >= widget.clipMin.x && at.x < widget.clipMax.x && at.y >= widget.clipMin.y &&
           at.y < widget.clipMax.y;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, bool hasTerminal)
    : host_(std::make_shared<PlayHost>()) {
    host_->isStandardErrorRead = [hasTerminal] { return hasTerminal; };
    host_->openWindow = [this](const WindowOptions& options) -> base::Result<std::unique_ptr<Window>> {
        auto made = OffscreenWindow::create(options, [this] {
            do {
                if (call_) std::exchange(call_, {})();
                ends_.release();
                begins_.acquire();
            } while (call_);
        });
        if (!made) return tl::unexpected(made.error());
        window_ = made->get();
        return std::move(*made);
    };
    thread_ = std::thread([this, arguments] {
        run(arguments);
        window_ = nullptr;
        hasEnded_ = true;
        ends_.release();
    });
    ends_.acquire();
}

Program::~Program() {
    while (!hasEnded_) {
        window_->isClosed = true;
        if (isPlaying()) host_->game->menu.quitsUnsaved = true;
        step();
    }
    thread_.join();
}

void Program::run(const std::vector<std::string>& arguments) {
    CLI::App parser;
    const CommandEntry play = addPlay(parser, host_);
    std::vector<const char*> all = {"terrane", "play"};
    for (const std::string& argument : arguments) all.push_back(argument.c_str());
    try {
        parser.parse(static_cast<int>(all.size()), all.data());
        result_ = play.run();
    } catch (const std::exception& error) {
        result_ = base::fail("{}", error.what());
    }
    if (!result_) play.showError(result_.error().message);
}

void Program::step() {
    if (beforeFrame) beforeFrame();
    begins_.release();
    ends_.acquire();
}

void Program::frames(int count) {
    for (int k = 0; k < count; ++k) {
        if (hasEnded_)
            throw std::runtime_error("the program ended: " + (result_ ? "" : result_.error().message));
        step();
    }
}

void Program::until(std::string_view what, const std::function<bool()>& condition) {
    for (int k = 0; k < kMostFrames; ++k) {
        if (condition()) return;
        frames();
    }
    std::string shown;
    for (const Widget& widget : window_->record.widgets())
        shown += fmt::format(" \"{}\" {}", widget.label, widget.value);
    throw std::runtime_error(fmt::format("this never happens: {}; shown:{}", what, shown));
}

void Program::untilDrawn() {
    until("the world is drawn", [&] {
        return isPlaying() && hasWorldImage(game().parts.renderer) &&
               session().pipeline().progress().complete() && game().parts.view.waiting() == 0;
    });
}

base::Result<void> Program::untilEnd() {
    for (int k = 0; k < kMostFrames && !hasEnded_; ++k) step();
    if (!hasEnded_) throw std::runtime_error("the program does not end");
    return result_;
}

base::Result<void> Program::quit() {
    press(Key::Escape);
    until("the menu is open", [&] { return game().menu.isPaused; });
    press(Key::Q);
    return untilEnd();
}

void Program::press(Key key, Modifiers with) {
    OffscreenWindow& w = window();
    if (with.shift) w.onKey(Key::Shift, true, with);
    if (with.control) w.onKey(Key::Control, true, with);
    w.onKey(key, true, with);
    w.onKey(key, false, with);
    frames();
    if (!window_) return;
    for (int k = 0; k < kSettling && !hasEnded_; ++k) step();
    if (!window_) return;
    if (with.control) w.onKey(Key::Control, false, {});
    if (with.shift) w.onKey(Key::Shift, false, {});
}

void Program::type(std::string_view text) {
    until("a field takes text", [] { return ImGui::GetIO().WantTextInput; });
    for (const char typed : text) {
        window().onKey(keyOf(typed), true, {});
        window().onCharacter(static_cast<unsigned char>(typed));
        window().onKey(keyOf(typed), false, {});
        frames();
    }
}

void Program::hold(Key key) {
    window().onKey(key, true, {});
    frames();
}

void Program::release(Key key) {
    window().onKey(key, false, {});
    frames();
}

void Program::tap(MouseButton button, Modifiers with) {
    window().onButton(button, true, with);
    window().onButton(button, false, with);
    frames();
}

void Program::hold(MouseButton button) {
    window().onButton(button, true, {});
    frames();
}

void Program::release(MouseButton button) {
    window().onButton(button, false, {});
    frames();
}

void Program::turnWheel(double steps) {
    window().onWheel({0, steps});
    frames();
}

void Program::moveMouse(glm::dvec2 by) {
    const glm::dvec2 at = window().cursorAt.value_or(glm::dvec2(0)) + by;
    window().cursorAt = at;
    window().onCursor(at);
    frames();
}

void Program::setPad(const std::optional<Gamepad>& pad) {
    window().pad = pad;
    frames();
}

const Widget* Program::find(std::string_view label, std::string_view value) const {
    if (!window_) return nullptr;
    for (const Widget& widget : window_->record.widgets())
        if (isNamed(widget.label, label) && (value.empty() || widget.value == value)) return &widget;
    return nullptr;
}

bool Program::isShown(std::string_view label, std::string_view value) const {
    return find(label, value) != nullptr;
}

const Widget& Program::widget(std::string_view label, std::string_view value) {
    until(fmt::format("\"{}\" {} is shown", label, value), [&] { return isShown(label, value); });
    return *find(label, value);
}

std::string Program::focused() const {
    for (const Widget& widget : window_->record.widgets())
        if (widget.isFocused) return widget.label;
    return {};
}

void Program::moveTo(std::string_view label, std::string_view value, double across) {
    const auto middle = [&] {
        const Widget& found = widget(label, value);
        const auto share = static_cast<float>(across);
        return ImVec2(found.min.x + (found.max.x - found.min.x) * share, (found.min.y + found.max.y) / 2);
    };
    (void)widget(label, value);
    frames(2);  // until a new window has its size
    for (int k = 0; k < 100 && !isVisible(widget(label, value), middle()); ++k) {
        const Widget& hidden = widget(label, value);
        const ImVec2 inside((hidden.clipMin.x + hidden.clipMax.x) / 2,
                            (hidden.clipMin.y + hidden.clipMax.y) / 2);
        window().cursorAt = glm::dvec2(inside.x, inside.y);
        turnWheel(middle().y > inside.y ? -1 : 1);
    }
    const ImVec2 at = middle();
    if (!isVisible(widget(label, value), at))
        throw std::runtime_error(fmt::format("\"{}\" cannot be scrolled to", label));
    window().cursorAt = glm::dvec2(at.x, at.y);
    window().onCursor(*window().cursorAt);
    frames();
}

void Program::click(std::string_view label, std::string_view value, double across, MouseButton button) {
    moveTo(label, value, across);
    hold(button);
    if (window_) release(button);
    for (int k = 0; k < kSettling && !hasEnded_; ++k) step();
}

void Program::callThere(std::function<void()> call) {
    call_ = std::move(call);
    step();
}

base::Image Program::worldImage() {
    base::Image image;
    callThere([&] { image = game().parts.renderer.readImage(); });
    return image;
}

GameState& Program::game() {
    if (!isPlaying()) throw std::runtime_error("no world is played");
    return *host_->game;
}

std::string Program::blockAt(world::BlockPos pos) {
    return session().blocks().type(session().world().block(pos)).name;
}

}  // namespace terrane::app
