#include "apps/terrane/window/places_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

bool drawNaming(PlacesState& state, std::vector<game::Place>& places, const world::Pose& here,
                const Texts& tr) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const float button = 90 * uiScale();
    ImGui::SetNextItemWidth(-button);
    const bool isEntered = ui::textField("##name", tr("name of this place"), state.name.data(),
                                         state.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if (!ui::button(tr("Add"), {-1, 0}) && !isEntered) return false;
    const bool isNamed = game::namePlace(places, state.name.data(), here);
    if (isNamed) state.name = {};
    return isNamed;
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
        const glm::dvec3 to = places[k].pose.position - here.position;
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(fmt::format("{}  ({:.0f} m)", places[k].name, std::hypot(to.x, to.y)).c_str());
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
