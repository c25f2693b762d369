#include "apps/terrane/window/hud/places_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/game/places.h"

namespace terrane::app {

namespace {

// The biomes of all built-in generators, listed here for translation (tests/app/text_test.cpp).
[[maybe_unused]] constexpr const char* kBiomes[] = {
    trLater("deep ocean"),   trLater("ocean"),         trLater("kelp forest"),   trLater("reef"),
    trLater("beach"),        trLater("stony shore"),   trLater("mangrove"),      trLater("meadow"),
    trLater("steppe"),       trLater("oak forest"),    trLater("beech forest"),  trLater("birch forest"),
    trLater("maple forest"), trLater("old forest"),    trLater("giant forest"),  trLater("swamp"),
    trLater("bog"),          trLater("taiga"),         trLater("fir forest"),    trLater("larch forest"),
    trLater("tundra"),       trLater("snow"),          trLater("glacier"),       trLater("alpine"),
    trLater("rocks"),        trLater("savanna"),       trLater("alpine meadow"), trLater("shrubland"),
    trLater("desert"),       trLater("canyon land"),   trLater("badlands"),      trLater("rain forest"),
    trLater("cloud forest"), trLater("bamboo forest"), trLater("cherry grove"),  trLater("lava field")};
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

void drawPlaceFacts(OverlayLayout& layout, const PlaceFacts& facts, const Texts& tr) {
    const std::string text = factsText(facts, tr);
    const float pad = 6 * uiScale(), widest = std::max(1.0f, layout.widest() - 2 * pad);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, widest);
    const auto rect = layout.place("position", {.size = {size.x + 2 * pad, size.y + 2 * pad},
                                                .minHeight = ImGui::GetFontSize() + 2 * pad});
    if (!rect) return;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const OverlayClip clip(draw, *rect);
    draw.AddRectFilled(rect->min, rect->max, IM_COL32(10, 12, 16, 150), pad);
    draw.AddText(nullptr, 0, {rect->min.x + pad, rect->min.y + pad}, IM_COL32(255, 255, 255, 255),
                 text.c_str(), nullptr, widest);
}

namespace {

bool drawNaming(PlacesState& state, std::vector<game::Place>& places, const world::Pose& here,
                const Texts& tr) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const float button = 90 * uiScale();
    ImGui::SetNextItemWidth(-button);
    const bool isEntered = ui::textField("##name", tr("name of this place"), state.name.data(),
                                         state.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    const bool isAsked = ui::button(tr("Add"), {-1, 0}) || isEntered;
    if (isAsked) {
        const auto named = game::namePlace(places, state.name.data(), here);
        state.problem = named ? std::string() : named.error().message;
        if (named) state.name = {};
    }
    if (!state.problem.empty()) ImGui::TextWrapped("%s", state.problem.c_str());
    return isAsked && state.problem.empty();
}

}  // namespace

PlacesAnswer drawPlaces(const Screen& screen, PlacesState& state, std::vector<game::Place>& places,
                        const world::Pose& here, const Texts& tr) {
    PlacesAnswer answer;
    const float width = std::min(380 * uiScale(), screen.width - 20 * uiScale());
    ImGui::SetNextWindowPos({screen.width / 2, screen.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, std::min(320 * uiScale(), screen.height - 20 * uiScale())});
    ui::beginWindow(tr("Places"),
                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
    answer.isChanged = drawNaming(state, places, here, tr);
    ImGui::Separator();
    ImGui::BeginChild("list");
    std::optional<std::size_t> removed;
    for (std::size_t k = 0; k < places.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (ui::button(tr("Go"), {0, 0}, places[k].name)) answer.goTo = places[k].pose;
        ImGui::SameLine();
        if (ui::button(tr("Remove"), {0, 0}, places[k].name)) removed = k;
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ui::wrappedText(
            fmt::format("{}  ({:.0f} m)", places[k].name, game::distanceBetween(here, places[k].pose)));
        ImGui::PopID();
    }
    if (places.empty())
        ImGui::TextWrapped("%s", tr("There are no named places yet. The compass and the maps show them."));
    ImGui::EndChild();
    ImGui::End();
    if (removed) places.erase(places.begin() + static_cast<std::ptrdiff_t>(*removed));
    answer.isChanged |= removed.has_value();
    return answer;
}

}  // namespace terrane::app
