#include "apps/terrane/window/hud/chat_view.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

constexpr std::size_t kMaxLines = 100, kShownLines = 8, kTypingLines = 16;
constexpr double kShownSeconds = 12, kFadeSeconds = 2;

ImU32 white(double share) {
    return IM_COL32(255, 255, 255, static_cast<int>(255 * share));
}

}  // namespace

void ChatView::add(const net::ChatLine& line, double seconds) {
    lines_.push_back({line.name.empty() ? line.text : line.name + ": " + line.text, seconds});
    if (lines_.size() > kMaxLines) lines_.pop_front();
}

void ChatView::beginTyping() {
    isTyping_ = takesFocus_ = true;
    typed_.fill(0);
}

std::optional<std::string> ChatView::draw(const Screen& screen, const Texts& tr, double seconds) {
    const float unit = uiScale(), width = screen.width * 0.55f;
    float bottom = screen.height * 0.72f;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const std::size_t most = isTyping_ ? kTypingLines : kShownLines;
    for (std::size_t k = 0; k < std::min(lines_.size(), most); ++k) {
        const ShownLine& line = lines_[lines_.size() - 1 - k];
        const double left = line.since + kShownSeconds - seconds;
        const double share = isTyping_ ? 1 : std::clamp(left / kFadeSeconds, 0.0, 1.0);
        if (share <= 0) break;
        const ImVec2 size = ImGui::CalcTextSize(line.text.c_str(), nullptr, false, width);
        const ImVec2 at(14 * unit, bottom - size.y);
        draw.AddRectFilled({at.x - 4 * unit, at.y - 1 * unit},
                           {at.x + size.x + 4 * unit, at.y + size.y + 1 * unit},
                           IM_COL32(10, 12, 16, static_cast<int>(150 * share)), 3 * unit);
        draw.AddText(nullptr, 0, at, white(share), line.text.c_str(), nullptr, width);
        bottom -= size.y + 3 * unit;
    }
    return isTyping_ ? drawInput(screen, tr) : std::nullopt;
}

std::optional<std::string> ChatView::drawInput(const Screen& screen, const Texts& tr) {
    ImGui::SetNextWindowPos({10 * uiScale(), screen.height * 0.74f}, ImGuiCond_Always);
    ui::beginWindow(tr("Chat"), ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove);
    if (takesFocus_) ImGui::SetKeyboardFocusHere();
    takesFocus_ = false;
    ImGui::SetNextItemWidth(screen.width * 0.5f);
    std::optional<std::string> entered;
    if (ui::textField("##chat", "", typed_.data(), typed_.size(), ImGuiInputTextFlags_EnterReturnsTrue)) {
        entered = typed_.data();
        isTyping_ = false;
    }
    ImGui::End();
    return entered;
}

void drawPlayerList(const Screen& screen, const Texts& tr, const net::PlayerList& list) {
    ImGui::SetNextWindowPos({screen.width / 2, screen.height * 0.1f}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {screen.width * 0.8f, screen.height * 0.7f});
    ui::beginWindow(tr("Players"), ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoInputs);
    if (ImGui::BeginTable("players", 3)) {
        for (const net::ListedPlayer& player : list.players) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(player.name.c_str());
            ImGui::TableNextColumn();
            if (player.role == game::Role::Operator) ImGui::TextUnformatted(tr("operator"));
            if (player.role == game::Role::Guest) ImGui::TextUnformatted(tr("guest"));
            ImGui::TableNextColumn();
            ImGui::Text("%d ms", player.latencyMs);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace terrane::app
