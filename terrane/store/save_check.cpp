#include "terrane/store/save_check.h"

#include <system_error>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"
#include "terrane/store/companion_files.h"
#include "terrane/store/log_check.h"
#include "terrane/store/save_file.h"

namespace terrane::store {
namespace {

constexpr int kMaxFileProblems = 20;  // one broken page brings many

base::Result<void> checkPages(Database& database, CheckReport& report) {
    auto check = database.prepare(fmt::format("PRAGMA integrity_check({})", kMaxFileProblems));
    if (!check) return tl::unexpected(check.error());
    while (true) {
        const auto row = check->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return {};
        if (check->text(0) != "ok") report.fileProblems.emplace_back(check->text(0));
    }
}

std::string problemOf(std::int64_t key, ByteView data, const BlockIdMap& ids) {
    if (!world::isInWorld(posOf(key))) return fmt::format("the key {} is no position", key);
    const auto chunk = decodeChunk(data, ids);
    return chunk ? "" : chunk.error().message;
}

base::Result<void> checkChunks(SaveFile& file, CheckReport& report) {
    auto select = file.database.prepare("SELECT key, origin, data FROM chunks ORDER BY key");
    if (!select) return tl::unexpected(select.error());
    while (true) {
        const auto row = select->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return {};
        ++report.chunks;
        const bool isTile = select->number(0) >= kFirstTileKey;
        if (isTile) ++report.tiles;
        if (!isTile && select->number(1) != 0) ++report.editedChunks;
        report.chunkBytes += select->blob(2).size();
        std::string problem = problemOf(select->number(0), select->blob(2), file.ids);
        if (!problem.empty()) report.damaged.push_back({posOf(select->number(0)), std::move(problem)});
    }
}

base::Result<void> countQuarantined(Database& database, CheckReport& report) {
    const auto count = database.queryNumber("SELECT count(*) FROM quarantine");
    if (!count) return tl::unexpected(count.error());
    report.quarantined = static_cast<std::size_t>(count->value_or(0));
    return {};
}

// What stops one check is damage too, and does not stop the others.
void note(CheckReport& report, const base::Result<void>& checked) {
    if (!checked) report.fileProblems.push_back(checked.error().message);
}

std::uint64_t sizeOf(std::filesystem::path path, const char* ending) {
    path += ending;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

}  // namespace

base::Result<CheckReport> checkSave(const std::filesystem::path& path, const world::BlockRegistry& registry) {
    CheckReport report;
    report.fileBytes = sizeOf(path, "") + sizeOf(path, "-wal");
    auto file = openToRead(path, registry);
    if (!file) {
        if (file.error().code != base::ErrorCode::Damaged) return tl::unexpected(file.error());
        report.fileProblems.push_back(file.error().message);
        return report;
    }
    report.format = file->format;
    report.identity = file->identity;
    report.unknownBlocks = file->ids.unknown();
    report.fileProblems = logProblems(file->database.path());
    if (hasLostLog(file->database.path()))
        report.fileProblems.push_back(
            fmt::format("{}-wal: it is gone, though a program that wrote to it was killed: what was saved "
                        "last is missing",
                        file->database.path()));
    note(report, checkPages(file->database, report));
    note(report, checkChunks(*file, report));
    note(report, countQuarantined(file->database, report));
    return report;
}

}  // namespace terrane::store
