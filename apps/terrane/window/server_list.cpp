#include "apps/terrane/window/server_list.h"

#include <sstream>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/net/client_socket.h"
#include "terrane/net/people.h"

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

base::Result<void> forgetServer(const std::filesystem::path& file, const std::string& server) {
    std::vector<PlayedServer> servers = readServers(file);
    if (std::erase_if(servers, [&](const PlayedServer& known) { return known.server == server; }) == 0)
        return {};
    return writeServers(file, servers);
}

}  // namespace terrane::app
