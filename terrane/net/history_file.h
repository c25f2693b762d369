// The history of a server's file, to be read while its server runs or not. One thread.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/net/edit_log.h"
#include "terrane/store/sqlite.h"

namespace terrane::net {

class HistoryFile {
  public:
    // Errors name the file.
    [[nodiscard]] static base::Result<HistoryFile> open(const std::filesystem::path& file,
                                                        const world::BlockRegistry& blocks);

    std::optional<game::PlayerId> playerCalled(std::string_view name) const;  // without case
    std::string nameOf(game::PlayerId player) const;                          // "the server" for kNoPlayer
    // The newest first; as net::forEachEdit().
    [[nodiscard]] base::Result<void> forEach(const EditFilter& filter, const UseEdit& use);

  private:
    HistoryFile(store::Database database, store::BlockIdMap ids)
        : database_(std::move(database)), ids_(std::move(ids)) {}

    store::Database database_;
    store::BlockIdMap ids_;
    std::map<game::PlayerId, std::string> names_;
};

}  // namespace terrane::net
