#include "apps/terrane/window/hud/building_tools.h"

#include <imgui.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include "apps/terrane/window/hud/name_tags.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {

namespace {

// Limits a line to its characters, wherever they are inserted.
int keepFitting(ImGuiInputTextCallbackData* data) {
    const auto length = static_cast<std::size_t>(data->BufTextLen);
    const std::size_t fitting = world::fittingBytes({data->Buf, length});
    if (fitting < length) data->DeleteChars(static_cast<int>(fitting), static_cast<int>(length - fitting));
    return 0;
}

}  // namespace

SignDialog::SignDialog(world::BlockPos sign, const world::SignText& text) : sign_(sign) {
    for (std::size_t k = 0; k < lines_.size(); ++k)
        std::copy_n(text[k].begin(), std::min(text[k].size(), lines_[k].size() - 1), lines_[k].begin());
}

world::SignText SignDialog::text() const {
    world::SignText text;
    for (std::size_t k = 0; k < lines_.size(); ++k) text[k] = lines_[k].data();
    return text;
}

void SignDialog::onKey(Key key) {
    if (key == Key::Enter) choice_ = Choice::Done;
    if (key == Key::Escape) choice_ = Choice::Cancel;
    if (key != Key::Up && key != Key::Down) return;
    line_ = (line_ + (key == Key::Down ? 1 : lines_.size() - 1)) % lines_.size();
    takesFocus_ = true;
}

std::optional<SignDialog::Choice> SignDialog::draw(const Screen& screen, const Texts& tr) {
    ImGui::SetNextWindowPos({screen.width / 2, screen.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ui::beginWindow(tr("Sign"), ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoCollapse);
    for (std::size_t k = 0; k < lines_.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (takesFocus_ && k == line_) ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(220 * uiScale());
        ui::textField("##line", "", lines_[k].data(), lines_[k].size(), ImGuiInputTextFlags_CallbackAlways,
                      keepFitting);
        if (ImGui::IsItemActive() && !takesFocus_) line_ = k;
        ImGui::PopID();
    }
    takesFocus_ = false;
    if (ui::button(tr("Done"))) choice_ = Choice::Done;
    ImGui::SameLine();
    if (ui::button(tr("Cancel"))) choice_ = Choice::Cancel;
    ImGui::SameLine();
    ImGui::TextUnformatted("Enter   Esc");
    ImGui::End();
    return choice_;
}

bool BuildingTools::onKey(Key key, const BuildView& view) {
    if (!sign_) return selection_.onKey(key, view);
    sign_->onKey(key);
    return true;
}

bool BuildingTools::openSign(world::BlockPos pos, const BuildView& view) {
    const world::World& world = view.session.world();
    if (!world::isSign(view.session.blocks().type(world.block(pos)))) return false;
    const world::BlockEntityData* data = world.blockEntityData(pos);
    const auto text = data ? world::decodeSign(*data) : base::Result<world::SignText>(world::SignText{});
    sign_.emplace(pos, text ? *text : world::SignText{});
    return true;
}

bool BuildingTools::close() {
    if (!sign_) return selection_.close();
    sign_.reset();
    return true;
}

void BuildingTools::drawInWorld(const Screen& screen, const render::Camera& camera, const BuildView& view,
                                double seconds) {
    drawSigns(screen, camera, view.session,
              signs_.at(seconds, [&] { return signsNear(view.session, camera.position); }));
    selection_.drawOutlines(screen, camera, view);
}

void BuildingTools::drawPanels(OverlayLayout& layout, const BuildView& view) {
    selection_.drawPanel(layout, view);
    if (sign_) drawSign(layout.screen(), view);
}

// Draws the open sign; closes it if it is gone or out of reach.
void BuildingTools::drawSign(const Screen& screen, const BuildView& view) {
    const world::BlockPos pos = sign_->sign();
    const glm::dvec3 middle(pos.x + 0.5, pos.y + 0.5, pos.z + 0.5);
    const bool isNear = glm::distance(middle, view.pose.position) <= game::kReach + 1;
    const bool isThere = world::isSign(view.session.blocks().type(view.session.world().block(pos)));
    const auto choice = sign_->draw(screen, view.tr);
    if (choice == SignDialog::Choice::Done) {
        const auto good = world::checkSign(sign_->text());
        if (!good)
            message_ = good.error().message;
        else
            view.session.edit({game::kLocalPlayer, pos,
                               world::SetEntityData{world::encodeSign(sign_->text())},
                               view.session.world().block(pos)});
    }
    if (choice || !isNear || !isThere) sign_.reset();
}

std::optional<std::string> BuildingTools::takeMessage() {
    if (message_) return std::exchange(message_, std::nullopt);
    return selection_.takeMessage();
}

}  // namespace terrane::app
