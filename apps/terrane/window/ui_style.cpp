#include "apps/terrane/window/ui_style.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

ImVec4 withAlpha(ImVec4 color, float alpha) {
    color.w = alpha;
    return color;
}

void setColors(ImGuiStyle& s) {
    const ImVec4 field(0.23f, 0.26f, 0.30f, 0.95f), raised(0.25f, 0.29f, 0.33f, 0.95f);
    s.Colors[ImGuiCol_Text] = colors::kText;
    s.Colors[ImGuiCol_TextDisabled] = colors::kDim;
    s.Colors[ImGuiCol_WindowBg] = ImVec4(0.06f, 0.07f, 0.09f, 0.84f);
    s.Colors[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
    s.Colors[ImGuiCol_PopupBg] = ImVec4(0.08f, 0.09f, 0.11f, 0.97f);
    s.Colors[ImGuiCol_TitleBg] = ImVec4(0.05f, 0.06f, 0.07f, 0.9f);
    s.Colors[ImGuiCol_TitleBgActive] = ImVec4(0.13f, 0.15f, 0.17f, 0.95f);
    s.Colors[ImGuiCol_FrameBg] = field;
    s.Colors[ImGuiCol_FrameBgHovered] = raised;
    s.Colors[ImGuiCol_FrameBgActive] = withAlpha(colors::kAccent, 0.35f);
    s.Colors[ImGuiCol_Button] = raised;
    s.Colors[ImGuiCol_ButtonHovered] = withAlpha(colors::kAccent, 0.45f);
    s.Colors[ImGuiCol_ButtonActive] = withAlpha(colors::kAccent, 0.7f);
    s.Colors[ImGuiCol_Header] = withAlpha(colors::kAccent, 0.28f);
    s.Colors[ImGuiCol_HeaderHovered] = withAlpha(colors::kAccent, 0.38f);
    s.Colors[ImGuiCol_HeaderActive] = withAlpha(colors::kAccent, 0.55f);
    s.Colors[ImGuiCol_CheckMark] = colors::kAccent;
    s.Colors[ImGuiCol_SliderGrab] = withAlpha(colors::kAccent, 0.85f);
    s.Colors[ImGuiCol_SliderGrabActive] = colors::kAccent;
    s.Colors[ImGuiCol_PlotHistogram] = colors::kAccent;
    s.Colors[ImGuiCol_NavHighlight] = colors::kAccent;
    s.Colors[ImGuiCol_TextSelectedBg] = withAlpha(colors::kAccent, 0.4f);
    s.Colors[ImGuiCol_Separator] = ImVec4(1, 1, 1, 0.12f);
}

// The letters of TERRANE in 5 rows; "#" is a block.
constexpr std::array<std::array<const char*, 5>, 7> kLetters = {{
    {"#####", "  #  ", "  #  ", "  #  ", "  #  "},
    {"#####", "#    ", "#### ", "#    ", "#####"},
    {"#### ", "#   #", "#### ", "#  # ", "#   #"},
    {"#### ", "#   #", "#### ", "#  # ", "#   #"},
    {" ### ", "#   #", "#####", "#   #", "#   #"},
    {"#   #", "##  #", "# # #", "#  ##", "#   #"},
    {"#####", "#    ", "#### ", "#    ", "#####"},
}};

// Grass on earth on stone, with small variations.
ImU32 blockColor(int row, int column) {
    const std::array<ImVec4, 5> colors = {ImVec4(0.49f, 0.74f, 0.33f, 1), ImVec4(0.42f, 0.64f, 0.29f, 1),
                                          ImVec4(0.60f, 0.44f, 0.30f, 1), ImVec4(0.52f, 0.38f, 0.26f, 1),
                                          ImVec4(0.55f, 0.56f, 0.58f, 1)};
    ImVec4 color = colors[static_cast<std::size_t>(row)];
    const float shade = 0.92f + 0.08f * static_cast<float>((row * 7 + column * 13) % 5) / 2;
    return ImGui::GetColorU32(ImVec4(std::min(1.0f, color.x * shade), std::min(1.0f, color.y * shade),
                                     std::min(1.0f, color.z * shade), 1));
}

void drawBlock(ImDrawList& draw, ImVec2 at, float size, ImU32 color) {
    const ImVec2 end(at.x + size, at.y + size);
    const float edge = std::max(1.0f, size / 8);
    draw.AddRectFilled(at, end, color);
    draw.AddRectFilled(at, {end.x, at.y + edge}, IM_COL32(255, 255, 255, 60));
    draw.AddRectFilled({at.x, end.y - edge}, end, IM_COL32(0, 0, 0, 70));
    draw.AddRectFilled({end.x - edge, at.y}, end, IM_COL32(0, 0, 0, 40));
}

}  // namespace

void setUiStyle(float scale) {
    ImGuiStyle s;
    ImGui::StyleColorsDark(&s);
    setColors(s);
    s.WindowRounding = 6;
    s.ChildRounding = 4;
    s.PopupRounding = 4;
    s.FrameRounding = 3;
    s.GrabRounding = 3;
    s.ScrollbarRounding = 4;
    s.WindowBorderSize = 0;
    s.ScaleAllSizes(scale);
    ImGui::GetStyle() = s;
}

void drawLogo(ImDrawList& draw, ImVec2 at, float blockSize) {
    for (const bool isShadow : {true, false}) {
        for (std::size_t letter = 0; letter < kLetters.size(); ++letter) {
            for (int row = 0; row < 5; ++row) {
                for (int column = 0; column < 5; ++column) {
                    const char* line = kLetters[letter][static_cast<std::size_t>(row)];
                    if (line[column] != '#') continue;
                    const int x = static_cast<int>(letter) * 6 + column;
                    ImVec2 corner(at.x + static_cast<float>(x) * blockSize,
                                  at.y + static_cast<float>(row) * blockSize);
                    if (!isShadow) {
                        drawBlock(draw, corner, blockSize, blockColor(row, x));
                        continue;
                    }
                    const float far = blockSize * 0.45f;
                    corner = {corner.x + far, corner.y + far};
                    draw.AddRectFilled(corner, {corner.x + blockSize, corner.y + blockSize},
                                       IM_COL32(10, 12, 16, 255));
                }
            }
        }
    }
}

void beginMenu(const MenuWindow& menu) {
    ImGui::SetNextWindowPos(menu.center, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(menu.size);
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoCollapse |
                                   (menu.hasTitle ? 0 : ImGuiWindowFlags_NoTitleBar);
    ui::beginWindow(menu.title, flags);
    if (!ImGui::IsWindowAppearing()) return;
    ImGui::SetWindowFocus();
    ImGui::GetCurrentContext()->NavDisableHighlight = false;  // show the focus to players without a mouse
}

bool menuButton(const char* label, float width) {
    return ui::button(label, {width, 30 * uiScale()});
}

bool menuButton(const char* label, float width, bool isEnabled) {
    ImGui::BeginDisabled(!isEnabled);
    const bool isPressed = menuButton(label, width);
    ImGui::EndDisabled();
    return isPressed && isEnabled;
}

bool tabButton(const char* label, bool isChosen, float width) {
    if (isChosen) {
        ImGui::PushStyleColor(ImGuiCol_Button, withAlpha(colors::kAccent, 0.85f));
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.08f, 0.08f, 0.08f, 1));
    }
    const bool isPressed = ui::button(label, {width, 24 * uiScale()});
    if (isChosen) ImGui::PopStyleColor(2);
    return isPressed;
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::TextColored(colors::kAccent, "%s", text);
    ui::noteArea("heading", text, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

void dimText(std::string_view text) {
    ImGui::TextColored(colors::kDim, "%.*s", static_cast<int>(text.size()), text.data());
}

void warningText(std::string_view text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colors::kWarning);
    ui::wrappedText(text);
    ImGui::PopStyleColor();
}

bool editText(const char* label, std::string& text, ImGuiInputTextFlags flags, const char* hint) {
    std::array<char, 256> buffer{};
    text.copy(buffer.data(), buffer.size() - 1);
    const bool isDone = ui::textField(label, hint, buffer.data(), buffer.size(), flags);
    text = buffer.data();
    return isDone;
}

void tooltipFor(std::string_view text) {
    const bool byKeys = ImGui::IsItemFocused() && ImGui::GetIO().NavVisible;
    if (!ImGui::IsItemHovered() && !byKeys) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(260 * uiScale());
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace terrane::app
