// The history of a world's servers, to be read while they run or not. One thread at a time.
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

// Of the file of a server. Errors name the file.
[[nodiscard]] base::Result<History> readHistoryFile(const std::filesystem::path& file,
                                                    const world::BlockRegistry& blocks);

std::optional<game::PlayerId> playerCalled(const History& history, std::string_view name);  // without case
std::string nameOf(const History& history, game::PlayerId player);  // "the server" for kNoPlayer

}  // namespace terrane::net
