#include "apps/terrane/window/place_overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "apps/terrane/window/imgui_layer.h"
#include "terrane/game/places.h"

namespace terrane::app {
namespace {

// The names of gen::continents::biomeName(), listed here for translation.
[[maybe_unused]] constexpr const char* kBiomes[] = {
    trLater("ocean"),       trLater("reef"),         trLater("beach"),      trLater("meadow"),
    trLater("oak forest"),  trLater("birch forest"), trLater("old forest"), trLater("taiga"),
    trLater("tundra"),      trLater("snow"),         trLater("savanna"),    trLater("desert"),
    trLater("canyon land"), trLater("swamp"),        trLater("alpine"),     trLater("rain forest")};
constexpr const char* kDirections[] = {trLater("north"),      trLater("north-east"), trLater("east"),
                                       trLater("south-east"), trLater("south"),      trLater("south-west"),
                                       trLater("west"),       trLater("north-west")};

std::string factsText(const PlaceFacts& f, const Texts& tr) {
    const auto write = [&](const char* format, const auto&... values) {
        return fmt::format(fmt::runtime(tr(format)), values...);
    };
    const glm::dvec3& p = f.pose.position;
    const double degrees = game::compassDegrees(f.pose.yaw);
    const auto direction = static_cast<std::size_t>(std::lround(degrees / 45)) % 8;
    const int minutes = static_cast<int>(f.timeDay * 24 * 60);
    std::string text = fmt::format("x {:.1f}  y {:.1f}  z {:.1f}\n", p.x, p.y, p.z - world::kEyeHeight);
    text += write(trLater("chunk {}, {}\n"), static_cast<int>(std::floor(p.x / 16)),
                  static_cast<int>(std::floor(p.y / 16)));
    text +=
        write(trLater("facing {} ({:.0f}°), {:+.0f}°\n"), tr(kDirections[direction]), degrees, f.pose.pitch);
    if (!f.biome.empty()) text += std::string(tr(f.biome.c_str())) + "\n";
    text += write(trLater("{:02}:{:02}   {:.0f} frames per second\n"), minutes / 60 % 24, minutes % 60,
                  f.framesASecond);
    text += f.world;
    if (!f.target.empty()) text += write(trLater("\ntarget: {}"), f.target);
    return text;
}

}  // namespace

void drawPlaceFacts(const PlaceFacts& facts, const Texts& tr) {
    const std::string text = factsText(facts, tr);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float margin = 10 * uiScale(), pad = 6 * uiScale();
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({margin, margin}, {margin + size.x + 2 * pad, margin + size.y + 2 * pad},
                       IM_COL32(10, 12, 16, 150), pad);
    draw.AddText({margin + pad, margin + pad}, IM_COL32(255, 255, 255, 255), text.c_str());
}

}  // namespace terrane::app
