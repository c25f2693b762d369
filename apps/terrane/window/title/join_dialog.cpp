#include "apps/terrane/window/title/join_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <sstream>
#include <system_error>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/base/files.h"
#include "terrane/net/client/client_socket.h"
#include "terrane/net/server/known_players.h"

namespace terrane::app {

namespace {

base::Result<void> writeServers(const std::filesystem::path& file, const std::vector<PlayedServer>& servers) {
    std::string text;
    for (const PlayedServer& played : servers) text += played.server + ' ' + played.name + '\n';
    std::error_code ignored;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
    return base::writeFile(file, text);
}

}  // namespace

std::filesystem::path serverListFile(const std::filesystem::path& dataFolder) {
    return dataFolder / "servers.txt";
}

std::vector<PlayedServer> readServers(const std::filesystem::path& file) {
    std::vector<PlayedServer> servers;
    const auto text = base::readFile(file);
    if (!text) return servers;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = line.find(' ');
        if (space == std::string::npos) continue;
        PlayedServer played{line.substr(0, space), line.substr(space + 1)};
        if (net::serverAddress(played.server) && net::isName(played.name))
            servers.push_back(std::move(played));
    }
    return servers;
}

base::Result<void> rememberServer(const std::filesystem::path& file, const PlayedServer& played) {
    std::vector<PlayedServer> servers = readServers(file);
    if (!servers.empty() && servers.front() == played) return {};
    std::erase_if(servers, [&](const PlayedServer& known) { return known.server == played.server; });
    servers.insert(servers.begin(), played);
    return writeServers(file, servers);
}

base::Result<void> removeServer(const std::filesystem::path& file, const std::string& server) {
    std::vector<PlayedServer> servers = readServers(file);
    if (std::erase_if(servers, [&](const PlayedServer& known) { return known.server == server; }) == 0)
        return {};
    return writeServers(file, servers);
}

void JoinDialog::open() {
    servers_ = readServers(listFile_);
    problem_.clear();
    options_.password.clear();
    if (servers_.empty()) return;
    options_.server = servers_.front().server;
    options_.name = servers_.front().name;
}

void JoinDialog::drawList(const Texts& tr) {
    if (servers_.empty()) return dimText(tr("You have not joined a server yet."));
    for (const PlayedServer& played : servers_) {
        ImGui::PushID(&played);
        const bool isChosen = played.server == options_.server;
        if (ui::selectable("##server", isChosen, played.server)) {
            options_ = {played.server, played.name, {}};
            problem_.clear();
        }
        ImGui::SameLine(0, 0);
        ImGui::TextUnformatted(played.server.c_str());
        ImGui::SameLine();
        dimText(played.name);
        ImGui::PopID();
    }
}

// True if Enter ends text input.
bool JoinDialog::drawFields(const Texts& tr) {
    ImGui::PushItemWidth(-1);
    dimText(tr("Server (HOST or HOST:PORT)"));
    if (ImGui::IsWindowAppearing() && servers_.empty()) ImGui::SetKeyboardFocusHere();
    bool isDone = editText("##address", options_.server, ImGuiInputTextFlags_EnterReturnsTrue);
    dimText(tr("Your name there"));
    isDone = editText("##player", options_.name, ImGuiInputTextFlags_EnterReturnsTrue) || isDone;
    dimText(tr("Password, if the server needs one"));
    isDone = editText("##password", options_.password,
                      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_Password) ||
             isDone;
    ImGui::PopItemWidth();
    return isDone;
}

bool JoinDialog::check() {
    problem_.clear();
    if (const auto address = net::serverAddress(options_.server); !address)
        problem_ = address.error().message;
    else if (!net::isName(options_.name))
        problem_ = net::nameRule();
    return problem_.empty();
}

void JoinDialog::forget() {
    if (const auto done = removeServer(listFile_, options_.server); !done) {
        problem_ = done.error().message;
        return;
    }
    servers_ = readServers(listFile_);
}

JoinDialog::Outcome JoinDialog::draw(const Screen& screen, const Texts& tr) {
    const float scale = uiScale(), margin = 12 * scale;
    beginMenu({tr("Join a server"),
               {screen.width / 2, screen.height / 2},
               {std::min(420 * scale, screen.width - 2 * margin), 0}});
    const float rows = std::clamp(static_cast<float>(servers_.size()), 1.0f, 5.0f);
    const float free = screen.height - 2 * margin - 230 * scale;
    ImGui::BeginChild("servers",
                      {0, std::clamp(free, ImGui::GetTextLineHeightWithSpacing(),
                                     (rows + 0.5f) * ImGui::GetTextLineHeightWithSpacing())},
                      false, ImGuiWindowFlags_NavFlattened);
    drawList(tr);
    ImGui::EndChild();
    bool isDone = drawFields(tr);
    if (!problem_.empty()) warningText(problem_);
    ImGui::Spacing();
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    isDone = menuButton(tr("Join"), width) || isDone;
    if (ImGui::IsWindowAppearing() && !servers_.empty()) ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    const bool isKnown = std::ranges::any_of(
        servers_, [&](const PlayedServer& played) { return played.server == options_.server; });
    if (menuButton(tr("Forget"), width, isKnown)) forget();
    ImGui::SameLine();
    const bool goesBack = menuButton(tr("Back"), width);
    ImGui::End();
    if (goesBack) return Outcome::Back;
    return isDone && check() ? Outcome::Join : Outcome::None;
}

}  // namespace terrane::app
