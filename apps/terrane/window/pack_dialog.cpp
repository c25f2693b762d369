#include "apps/terrane/window/pack_dialog.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/client_packs.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"

namespace terrane::app {

PackAnswer drawPackDialog(const Screen& screen, const Texts& tr, const std::string& server,
                          std::span<const net::PackOffer> packs) {
    PackAnswer answer = PackAnswer::None;
    beginMenu({tr("Content packs"),
               {screen.width / 2, screen.height / 2},
               {std::min(420 * uiScale(), screen.width - 20), 0}});
    ImGui::TextWrapped(tr("%s uses content packs that are not here. They are kept for the next time."),
                       server.c_str());
    for (const net::PackOffer& pack : packs) dimText(describe(std::span(&pack, 1)));
    ImGui::Spacing();
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (menuButton(tr("Load them"), width)) answer = PackAnswer::Accept;
    if (ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (menuButton(tr("Cancel"), width)) answer = PackAnswer::Refuse;
    ImGui::End();
    return answer;
}

}  // namespace terrane::app
