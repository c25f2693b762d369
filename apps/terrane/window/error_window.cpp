#include "apps/terrane/window/error_window.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/base/platform.h"
#include "terrane/base/process.h"
#include "terrane/gpu/framebuffer.h"

namespace terrane::app {
namespace {

// Without vertical sync, such as on a virtual screen, nothing else slows the loop down.
constexpr std::chrono::milliseconds kErrorPause{15};

bool closesError(const InputEvent& event) {
    return event.type == InputEvent::Type::KeyPress && (event.key == Key::Escape || event.key == Key::Q);
}

// Returns whether the player is done.
bool drawError(Window& window, ImVec2 screen, const std::string& error, const Texts& tr) {
    const float margin = 20 * uiScale();
    beginMenu({tr("Terrane ended with an error"), {screen.x / 2, screen.y / 2}, {screen.x - 2 * margin, 0}});
    warningText(error);
    ImGui::Spacing();
    const bool isDone = menuButton(tr("Quit (Q)"));
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    if (menuButton(tr("Copy the text"))) window.setClipboard(error);
    ImGui::End();
    return isDone;
}

}  // namespace

bool isStandardErrorRead() {
    namespace platform = base::platform;
    return platform::isPipe(2) || platform::isTerminal(0) || platform::isTerminal(1) ||
           platform::isTerminal(2);
}

WindowOptions errorWindowOptions() {
    return {.title = "Terrane", .width = 640, .height = 240, .drawsWorlds = false};
}

void showError(Window& window, const std::string& error, const Texts& tr) {
    const base::StopSignals signals;
    ImguiLayer imgui(window);
    window.setCursorCaptured(false);
    bool isDone = false;
    while (!isDone && !window.shouldClose() && !signals.stopRequested()) {
        window.pollEvents();
        isDone = std::ranges::any_of(window.events(), closesError);
        if (const glm::ivec2 pixels = window.framebufferSize(); pixels.x > 0 && pixels.y > 0) {
            gpu::clearWindow({0.12f, 0.15f, 0.18f});
            imgui.beginFrame(false, true);
            isDone |= drawError(window, ImGui::GetIO().DisplaySize, error, tr);
            imgui.endFrame();
            window.swapBuffers();
        }
        std::this_thread::sleep_for(kErrorPause);
    }
}

}  // namespace terrane::app
