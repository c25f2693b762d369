// The servers that the player was on, the last one first: a text file with a line "HOST:PORT NAME" each,
// where NAME is the player's. One thread at a time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::app {

struct PlayedServer {
    std::string server;  // HOST:PORT
    std::string name;    // of the player

    bool operator==(const PlayedServer&) const = default;
};

std::filesystem::path serverListFile(const std::filesystem::path& dataFolder);

// Skips malformed lines. Empty if there is no file.
std::vector<PlayedServer> readServers(const std::filesystem::path& file);

// Moves a server to the front. Creates the file and its folder.
[[nodiscard]] base::Result<void> rememberServer(const std::filesystem::path& file,
                                                const PlayedServer& played);
[[nodiscard]] base::Result<void> forgetServer(const std::filesystem::path& file, const std::string& server);

}  // namespace terrane::app
