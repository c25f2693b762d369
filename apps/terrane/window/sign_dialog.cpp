#include "apps/terrane/window/sign_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <string>

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

}  // namespace terrane::app
