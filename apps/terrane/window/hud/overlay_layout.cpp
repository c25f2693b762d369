#include "apps/terrane/window/hud/overlay_layout.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

constexpr float kEdge = 8, kBetween = 4;  // margins at edges and between overlays, before scaling
constexpr std::string_view kOverlayMark = "###overlay ";

// Windows on the screen in the last frame that are no overlays: dialogs and menus. Not tooltips and lists of
// combo boxes, which belong to a window, nor Dear ImGui's own window.
bool isDialog(const ImGuiWindow& window) {
    constexpr ImGuiWindowFlags kParts =
        ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_Popup;
    return window.WasActive && !window.Hidden && !window.IsFallbackWindow && (window.Flags & kParts) == 0 &&
           std::string_view(window.Name).find(kOverlayMark) == std::string_view::npos;
}

}  // namespace

OverlayLayout::OverlayLayout(const Screen& screen) : screen_(screen) {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        const ImRect rect = window->Rect();
        if (isDialog(*window)) taken_.push_back({rect.Min, rect.Max});
    }
}

float OverlayLayout::margin() const {
    return kEdge * uiScale();
}

float OverlayLayout::widest() const {
    return std::max(0.0f, screen_.width - 2 * margin());
}

std::optional<OverlayRect> OverlayLayout::place(std::string_view name, const OverlayPlace& wanted) {
    const auto rect = find(wanted);
    if (rect) enter(name, *rect);
    return rect;
}

std::optional<OverlayRect> OverlayLayout::find(const OverlayPlace& wanted) const {
    const float edge = margin(), between = kBetween * uiScale();
    const float width = std::min(wanted.size.x, widest()), height = wanted.size.y;
    if (width <= 0 || height <= 0) return std::nullopt;
    const float left = std::floor(edge + (widest() - width) * wanted.alignX), right = left + width;
    std::vector<OverlayRect> inColumn;
    for (const OverlayRect& rect : taken_)
        if (rect.min.x < right + between && left < rect.max.x + between) inColumn.push_back(rect);
    std::ranges::sort(inColumn, {}, [](const OverlayRect& rect) { return rect.min.y; });
    inColumn.push_back({{0, screen_.height - edge + between}, {0, 0}});  // the lower edge of the screen
    std::optional<OverlayRect> best, highest;
    float top = edge;
    for (const OverlayRect& rect : inColumn) {
        const float bottom = rect.min.y - between;
        if (bottom - top >= height) {
            const float y = std::floor(std::clamp(wanted.top, top, bottom - height));
            const float shift = std::abs(y - wanted.top);
            if (shift <= wanted.reach && (!best || shift < std::abs(best->min.y - wanted.top)))
                best = OverlayRect{{left, y}, {right, y + height}};
        }
        if (bottom > top && (!highest || bottom - top > highest->height()))
            highest = OverlayRect{{left, top}, {right, bottom}};
        top = std::max(top, std::ceil(rect.max.y + between));
    }
    if (!best && wanted.minHeight > 0 && highest && highest->height() >= wanted.minHeight) best = highest;
    return best;
}

bool OverlayLayout::placeAt(std::string_view name, const OverlayRect& rect) {
    if (std::ranges::any_of(taken_, [&](const OverlayRect& taken) { return taken.overlaps(rect); }))
        return false;
    enter(name, rect);
    return true;
}

void OverlayLayout::enter(std::string_view name, const OverlayRect& rect) {
    taken_.push_back(rect);
    ui::noteArea("overlay", name, rect.min, rect.max);
}

bool OverlayLayout::beginWindow(const Window& window, OverlayPlace wanted) {
    const std::string title = fmt::format("{}{}{}", window.title, kOverlayMark, window.id);
    ImGuiWindow* known = ImGui::FindWindowByName(title.c_str());
    // In the frame before its contents were measured Dear ImGui hides the window.
    if (known) {
        wanted.size = ImGui::CalcWindowNextAutoFitSize(known);
        if (window.width > 0) wanted.size.x = std::min(window.width, widest());
        auto rect = find(wanted);
        const bool isCut = rect && rect->height() < wanted.size.y;
        if (isCut && window.width == 0 && (window.flags & ImGuiWindowFlags_NoScrollbar) == 0) {
            wanted.size.x += ImGui::GetStyle().ScrollbarSize;
            rect = find(wanted);
        }
        if (!rect) return false;
        enter(window.id, *rect);
        ImGui::SetNextWindowPos(rect->min);
        ImGui::SetNextWindowSize({rect->width(), rect->height()});
    } else if (window.width > 0) {
        ImGui::SetNextWindowSize({std::min(window.width, widest()), 0});
    }
    ui::beginWindow(title.c_str(), window.flags | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
    return true;
}

}  // namespace terrane::app
