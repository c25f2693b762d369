// Records in a server's file (server_file.h), used by one server at a time.
#pragma once

#include <memory>

#include "terrane/net/server_file.h"
#include "terrane/net/server_records.h"

namespace terrane::net {

class SqliteRecords : public ServerRecords {
  public:
    // See ServerFile::open().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteRecords>> open(
        const std::filesystem::path& path, const world::BlockRegistry& blocks);
    explicit SqliteRecords(std::unique_ptr<ServerFile> file) : file_(std::move(file)) {}

    [[nodiscard]] base::Result<std::vector<KnownPlayer>> players() override;
    [[nodiscard]] base::Result<std::vector<game::Claim>> claims() override;
    [[nodiscard]] base::Result<std::string> text(const std::string& name) override;
    [[nodiscard]] base::Result<HistoryEnds> historyEnds() override;
    [[nodiscard]] base::Result<void> forEachEdit(const EditFilter& filter, EditOrder order,
                                                 const UseEdit& use) override;

    void addPlayer(const KnownPlayer& player) override;
    void changePlayer(game::PlayerId id, const PlayerChange& change) override;
    void addClaim(const game::Claim& claim) override;
    void removeClaim(const std::string& name) override;
    void setText(const std::string& name, const std::string& text) override;
    std::uint64_t append(const std::vector<LoggedEdit>& edits) override;
    void setSavedEdit(std::int64_t number) override;

    std::uint64_t durable() const override { return file_->durable(); }
    std::string problem() const override { return file_->problem(); }
    [[nodiscard]] base::Result<void> flush() override { return file_->flush(); }

    ServerFile& file() { return *file_; }

  private:
    std::unique_ptr<ServerFile> file_;
};

}  // namespace terrane::net
