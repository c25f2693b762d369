// Read access to the edit history of a world's servers, also while they run. One thread at a time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/net/edit_log.h"

namespace terrane::net {

struct History {
    std::map<game::PlayerId, std::string> names;
    ForEachEdit forEachEdit;  // as ServerRecords::forEachEdit()
};

// Opens the history in a server's file. Errors name the file.
[[nodiscard]] base::Result<History> readHistoryFile(const std::filesystem::path& file,
                                                    const world::BlockRegistry& blocks);

std::optional<game::PlayerId> playerCalled(const History& history, std::string_view name);  // ignores case
std::string nameOf(const History& history, game::PlayerId player);  // "the server" for kNoPlayer

}  // namespace terrane::net
