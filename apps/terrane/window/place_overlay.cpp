#include "apps/terrane/window/place_overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "apps/terrane/window/imgui_layer.h"
#include "terrane/game/places.h"

namespace terrane::app {
namespace {

constexpr const char* kDirections[] = {"north", "north-east", "east", "south-east",
                                       "south", "south-west", "west", "north-west"};

std::string factsText(const PlaceFacts& f) {
    const glm::dvec3& p = f.pose.position;
    const double degrees = game::compassDegrees(f.pose.yaw);
    const auto direction = static_cast<std::size_t>(std::lround(degrees / 45)) % 8;
    const int minutes = static_cast<int>(f.timeDay * 24 * 60);
    const double feet = p.z - world::kEyeHeight;
    std::string text =
        fmt::format("x {:.1f}  y {:.1f}  z {:.1f}\nchunk {}, {}\nlooks {} ({:.0f}°), {:+.0f}°\n", p.x, p.y,
                    feet, static_cast<int>(std::floor(p.x / 16)), static_cast<int>(std::floor(p.y / 16)),
                    kDirections[direction], degrees, f.pose.pitch);
    if (!f.biome.empty()) text += f.biome + "\n";
    text += fmt::format("{:02}:{:02}   {:.0f} frames a second\n{}", minutes / 60 % 24, minutes % 60,
                        f.framesASecond, f.world);
    if (!f.target.empty()) text += "\nat " + f.target;
    return text;
}

}  // namespace

void drawPlaceFacts(const PlaceFacts& facts) {
    const std::string text = factsText(facts);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float margin = 10 * uiScale(), pad = 6 * uiScale();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({margin, margin}, {margin + size.x + 2 * pad, margin + size.y + 2 * pad},
                       IM_COL32(10, 12, 16, 150), pad);
    draw.AddText({margin + pad, margin + pad}, IM_COL32(255, 255, 255, 255), text.c_str());
}

}  // namespace terrane::app
