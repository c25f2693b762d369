#include "apps/terrane/window/hud/chat_view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

// 500 lines of at most 24 + 2 + 400 bytes are 213 KB.
constexpr std::size_t kMaxLines = 500, kShownLines = 8, kTypingLines = 16;
constexpr double kShownSeconds = 12, kFadeSeconds = 2;

ImU32 white(double share) {
    return IM_COL32(255, 255, 255, static_cast<int>(255 * share));
}

}  // namespace

void ChatView::add(const net::ChatLine& line, double seconds) {
    lines_.push_back({line.name.empty() ? line.text : line.name + ": " + line.text, seconds});
    if (newer_ > 0) ++newer_;
    if (lines_.size() > kMaxLines) lines_.pop_front();
    newer_ = std::min(newer_, lines_.size() - 1);
}

void ChatView::beginTyping() {
    isTyping_ = takesFocus_ = true;
    typed_.fill(0);
}

void ChatView::endTyping() {
    isTyping_ = false;
    newer_ = 0;
}

void ChatView::scroll(int lines) {
    if (!isTyping_ || lines_.empty()) return;
    const auto most = static_cast<std::int64_t>(lines_.size()) - 1;
    newer_ = static_cast<std::size_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(newer_) + lines, 0, most));
}

std::optional<std::string> ChatView::draw(OverlayLayout& layout, const Texts& tr, double seconds) {
    std::optional<std::string> entered;
    if (isTyping_) entered = drawInput(layout, tr);  // before the lines: it has the first claim to its place
    drawLines(layout, tr, seconds);
    return entered;
}

void ChatView::drawLines(OverlayLayout& layout, const Texts& tr, double seconds) {
    const float unit = uiScale(), pad = 4 * unit, gap = 3 * unit;
    const float width = std::max(1.0f, std::min(layout.screen().width * 0.55f, layout.widest()) - 2 * pad);
    const auto heightOf = [&](const ShownLine& line) {
        return ImGui::CalcTextSize(line.text.c_str(), nullptr, false, width).y + gap;
    };
    const auto shareOf = [&](const ShownLine& line) {
        return isTyping_ ? 1 : std::clamp((line.since + kShownSeconds - seconds) / kFadeSeconds, 0.0, 1.0);
    };
    // The oldest line is not scrolled below the upper edge of a full page.
    const std::size_t most = isTyping_ ? kTypingLines : kShownLines;
    newer_ = std::min(newer_, lines_.size() - std::min(lines_.size(), static_cast<std::size_t>(pageLines_)));
    const std::size_t end = lines_.size() - newer_;
    std::size_t begin = end;
    float height = 0, widest = 0;
    while (begin > 0 && end - begin < most && shareOf(lines_[begin - 1]) > 0) {
        height += heightOf(lines_[--begin]);
        widest = std::max(widest, ImGui::CalcTextSize(lines_[begin].text.c_str(), nullptr, false, width).x);
    }
    const std::string below =
        newer_ == 0 ? "" : fmt::format(fmt::runtime(tr("newer lines: {} (Page Down)")), newer_);
    const float footer = below.empty() ? 0 : ImGui::GetFontSize() + gap;
    widest = std::max(widest, ImGui::CalcTextSize(below.c_str()).x);
    if (begin == end) return;
    const float line = ImGui::GetFontSize() + gap;
    const auto rect = layout.place("chat", {.size = {widest + 2 * pad, height + footer},
                                            .top = layout.screen().height * 0.72f - height - footer,
                                            .minHeight = line + footer});
    if (!rect) return;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const OverlayClip clip(draw, *rect);
    const auto drawText = [&](const std::string& text, float bottom, double share) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
        const ImVec2 at(rect->min.x + pad, bottom - gap / 2 - size.y);
        draw.AddRectFilled({at.x - pad, at.y - unit}, {at.x + size.x + pad, at.y + size.y + unit},
                           IM_COL32(10, 12, 16, static_cast<int>(150 * share)), 3 * unit);
        draw.AddText(nullptr, 0, at, white(share), text.c_str(), nullptr, width);
    };
    float bottom = rect->max.y;
    if (!below.empty()) drawText(below, bottom, 0.7);
    bottom -= footer;
    int shown = 0;
    for (std::size_t k = end; k > begin && bottom > rect->min.y; --k) {
        drawText(lines_[k - 1].text, bottom, shareOf(lines_[k - 1]));
        ui::noteArea("chat line", lines_[k - 1].text, {rect->min.x, bottom - heightOf(lines_[k - 1])},
                     {rect->max.x, bottom});
        bottom -= heightOf(lines_[k - 1]);
        if (bottom > rect->min.y - 1) ++shown;
    }
    pageLines_ = std::max(1, shown);
}

std::optional<std::string> ChatView::drawInput(OverlayLayout& layout, const Texts& tr) {
    std::optional<std::string> entered;
    if (!layout.beginWindow({.title = tr("Chat"), .id = "chat input", .flags = ImGuiWindowFlags_NoDecoration},
                            {.top = layout.screen().height * 0.74f}))
        return entered;
    if (takesFocus_) ImGui::SetKeyboardFocusHere();
    takesFocus_ = false;
    ImGui::SetNextItemWidth(layout.screen().width * 0.5f);
    if (ui::textField("##chat", "", typed_.data(), typed_.size(), ImGuiInputTextFlags_EnterReturnsTrue)) {
        entered = typed_.data();
        endTyping();
    }
    ImGui::End();
    return entered;
}

void drawPlayerList(OverlayLayout& layout, const Texts& tr, const net::PlayerList& list) {
    const bool isShown = layout.beginWindow({.title = tr("Players"),
                                             .id = "players",
                                             .flags = OverlayLayout::kPassive | ImGuiWindowFlags_NoInputs},
                                            {.alignX = 0.5f,
                                             .top = layout.screen().height * 0.1f,
                                             .minHeight = 3 * ImGui::GetTextLineHeightWithSpacing()});
    if (!isShown) return;
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
