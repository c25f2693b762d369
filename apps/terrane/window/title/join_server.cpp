#include "apps/terrane/window/title/join_server.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/text.h"
#include "apps/terrane/window/ui_style.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/net/client/client_packs.h"

namespace terrane::app {

PackAnswer drawPackDialog(const Screen& screen, const Texts& tr, const std::string& server,
                          std::span<const net::PackOffer> packs) {
    PackAnswer answer = PackAnswer::None;
    beginMenu({tr("Content packs"),
               {screen.width / 2, screen.height / 2},
               {std::min(420 * uiScale(), screen.width - 20), 0}});
    ImGui::TextWrapped(tr("%s uses content packs that are not here. They are kept for the next time."),
                       server.c_str());
    for (const net::PackOffer& pack : packs) dimText(net::textOf(std::span(&pack, 1)));
    ImGui::Spacing();
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (menuButton(tr("Load them"), width)) answer = PackAnswer::Accept;
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (menuButton(tr("Cancel"), width)) answer = PackAnswer::Refuse;
    ImGui::End();
    return answer;
}

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
        const bool isOver = window.shouldClose() || join.signals.stopRequested();
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
        OverlayLayout layout(screen);
        drawMessage(layout, message, 1);
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
