// Places of the overlays of a frame (HUD, notices, panels): none covers another one or an open dialog. They
// are placed one after another, so the order of the calls is their priority. Used during a frame of Dear
// ImGui, on its thread.
#pragma once

#include <imgui.h>

#include <cfloat>
#include <optional>
#include <string_view>
#include <vector>

#include "apps/terrane/window/hud/overlay.h"

namespace terrane::app {

struct OverlayRect {
    ImVec2 min{0, 0}, max{0, 0};

    float width() const { return max.x - min.x; }
    float height() const { return max.y - min.y; }
    bool overlaps(const OverlayRect& other) const {
        return min.x < other.max.x && other.min.x < max.x && min.y < other.max.y && other.min.y < max.y;
    }
};

// Size and preferred place of an overlay. It moves up or down from there as far as needed. Where no gap is
// high enough it takes the highest one, cut; with less than `minHeight` it is not shown.
struct OverlayPlace {
    ImVec2 size{0, 0};
    float alignX = 0;       // 0: at the left edge, 0.5: in the middle, 1: at the right edge
    float top = 0;          // preferred upper edge
    float minHeight = 0;    // 0: it is not cut
    float reach = FLT_MAX;  // it moves no farther: else it is not shown
};

class OverlayLayout {
  public:
    // Keeps free what the dialogs of the last frame cover.
    explicit OverlayLayout(const Screen& screen);

    const Screen& screen() const { return screen_; }
    float margin() const;  // from the edges of the screen
    float widest() const;  // between the margins
    // `name`: for tests, which find the rectangle as a widget "overlay" with this value.
    std::optional<OverlayRect> place(std::string_view name, const OverlayPlace& wanted);
    // Takes exactly this rectangle; false if it is not free.
    bool placeAt(std::string_view name, const OverlayRect& rect);

    // Of windows without a part in the focus, as most overlays are.
    static constexpr ImGuiWindowFlags kPassive = ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    static constexpr ImGuiWindowFlags kBare =
        kPassive | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs;
    // Begins a window that is as large as its contents; false, without a window to end, if there is no place.
    // `width`: fixed; 0: of the contents. The window's title is "title###overlay ID".
    struct Window {
        const char* title = "";
        const char* id = "";
        float width = 0;
        ImGuiWindowFlags flags = 0;
    };
    bool beginWindow(const Window& window, OverlayPlace wanted);

  private:
    std::optional<OverlayRect> find(const OverlayPlace& wanted) const;
    void enter(std::string_view name, const OverlayRect& rect);

    Screen screen_;
    std::vector<OverlayRect> taken_;
};

// Confines what is drawn into the list to the rectangle, as long as it exists.
class OverlayClip {
  public:
    OverlayClip(ImDrawList& draw, const OverlayRect& rect) : draw_(draw) {
        draw_.PushClipRect(rect.min, rect.max);
    }
    ~OverlayClip() { draw_.PopClipRect(); }
    OverlayClip(const OverlayClip&) = delete;
    OverlayClip& operator=(const OverlayClip&) = delete;

  private:
    ImDrawList& draw_;
};

}  // namespace terrane::app
