#include "apps/terrane/window/key_help_table.h"

#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/key_help.h"

namespace terrane::app {

// A line is "  keys   action", with at least two spaces between them.
std::vector<KeyHelpLine> keyHelpLines() {
    std::vector<KeyHelpLine> lines;
    for (std::string_view rest = kKeyHelp; !rest.empty();) {
        std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        const std::size_t gap = std::min(line.find("  "), line.size());
        const std::size_t action = std::min(line.find_first_not_of(' ', gap), line.size());
        lines.push_back({std::string(line.substr(0, gap)), std::string(line.substr(action))});
    }
    return lines;
}

void drawKeyHelp(float width, const Texts& tr) {
    static const std::vector<KeyHelpLine> kLines = keyHelpLines();
    float column = 0;
    for (const KeyHelpLine& line : kLines)
        column = std::max(column, ImGui::CalcTextSize(tr(line.keys.c_str())).x);
    ImGui::PushTextWrapPos(width);
    for (const KeyHelpLine& line : kLines) {
        ImGui::TextUnformatted(tr(line.keys.c_str()));
        ImGui::SameLine(column + 24 * uiScale());
        ImGui::TextUnformatted(tr(line.action.c_str()));
    }
    ImGui::PopTextWrapPos();
}

}  // namespace terrane::app
