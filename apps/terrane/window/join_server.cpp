#include "apps/terrane/window/join_server.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/pack_dialog.h"
#include "apps/terrane/window/text.h"
#include "terrane/gpu/framebuffer.h"

namespace terrane::app {
namespace {

struct JoinWindow {
    Window& window;
    const base::StopSignals& signals;
    const Texts& tr;
};

// Draws frames over a plain background until `draw` returns true. False if the player cancels.
bool drawUntil(const JoinWindow& join, const std::function<bool(const Screen&)>& draw) {
    Window& window = join.window;
    ImguiLayer imgui(window);
    while (true) {
        window.pollEvents();
        const auto isEscape = [](const InputEvent& event) {
            return event.type == InputEvent::Type::KeyPress && event.key == Key::Escape;
        };
        const bool isOver = window.shouldClose() || join.signals.stopAsked();
        if (isOver || std::ranges::any_of(window.events(), isEscape)) return false;
        gpu::clearWindow(glm::vec3(0.2f, 0.3f, 0.4f));
        imgui.beginFrame(false, true);
        const bool isDone = draw({imgui.size().x, imgui.size().y});
        imgui.endFrame();
        window.swapBuffers();
        if (isDone) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

// Waits until the player has joined (true) or cancels (false); fails if the server refuses.
base::Result<bool> waitForServer(const JoinWindow& join, RemotePlay& play) {
    using Stage = net::ClientLink::Stage;
    const std::string message = fmt::format(fmt::runtime(join.tr("joining {}")), play.address());
    const bool isDone = drawUntil(join, [&](const Screen& screen) {
        play.poll();
        drawMessage(screen, message, 1);
        return play.stage() == Stage::Joined || play.stage() == Stage::Ended;
    });
    if (isDone && play.stage() == Stage::Ended) return base::fail("{}", play.reason());
    return isDone;
}

bool acceptsPacks(const JoinWindow& join, const RemotePlay& play) {
    PackAnswer answer = PackAnswer::None;
    (void)drawUntil(join, [&](const Screen& screen) {
        answer = drawPackDialog(screen, join.tr, play.address(), play.missingPacks());
        return answer != PackAnswer::None;
    });
    return answer == PackAnswer::Accept;
}

}  // namespace

base::Result<std::unique_ptr<RemotePlay>> joinServer(Window& window, const base::StopSignals& signals,
                                                     const std::string& language, RemoteOptions options,
                                                     const std::filesystem::path& dataFolder) {
    const Texts tr = textsOf(language);
    const JoinWindow join{window, signals, tr};
    while (true) {
        auto play = TERRANE_TRY(RemotePlay::connect(options, dataFolder));
        const auto joined = waitForServer(join, *play);
        if (joined && *joined) return play;
        if (joined) return nullptr;
        // The player decides about the missing packs; then joins again.
        if (play->missingPacks().empty()) return tl::unexpected(joined.error());
        if (!acceptsPacks(join, *play)) return nullptr;
        for (const net::PackOffer& pack : play->missingPacks()) options.acceptedPacks.push_back(pack.hash);
    }
}

}  // namespace terrane::app
