#include "terrane/store/save_check.h"

#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"
#include "terrane/store/chunk_reader.h"
#include "terrane/store/companion_files.h"
#include "terrane/store/log_check.h"
#include "terrane/store/save_file.h"

namespace terrane::store {
namespace {

constexpr int kMaxFileProblems = 20;  // one broken page causes many
constexpr std::size_t kMaxListedDamage = 1000;

// Each line is a separate problem. Runs only after all rows were read without an error: damaged page trees,
// such as a page that is its own ancestor, stop reading, but make integrity_check recurse without a limit.
base::Result<void> checkPages(Database& database, CheckReport& report) {
    const auto take = [&](const Statement& row) -> base::Result<void> {
        if (row.text(0) == "ok") return {};
        std::istringstream lines{std::string(row.text(0))};
        for (std::string line; std::getline(lines, line);) report.fileProblems.push_back(line);
        return {};
    };
    return forEachRow(database, fmt::format("PRAGMA integrity_check({})", kMaxFileProblems), take);
}

std::string problemOf(const Statement& row, const SaveFile& file) {
    if (!world::isInWorld(posOf(row.number(0))))
        return fmt::format("the key {} is not a position", row.number(0));
    const std::uint64_t seed = seedOf(posOf(row.number(0)), row.number(1), file.format);
    const auto chunk = decodeChunk(row.blob(2), file.ids, seed);
    return chunk ? "" : chunk.error().message;
}

// Calls `visit` for each row, ordered by its first column, a number. A page with two parents repeats rows,
// perhaps forever: then they are out of order.
template <class Visit>
base::Result<void> forEachRowInOrder(Database& database, std::string_view sql, Visit visit) {
    std::optional<std::int64_t> last;
    return forEachRow(database, sql, [&](const Statement& row) -> base::Result<void> {
        const std::int64_t number = row.number(0);
        if (last && number <= *last)
            return base::fail(base::ErrorCode::Damaged, "{}: damaged: rows are out of order after {}",
                              database.path(), *last);
        last = number;
        return visit(row);
    });
}

base::Result<void> checkChunks(SaveFile& file, CheckReport& report) {
    const auto check = [&](const Statement& row) -> base::Result<void> {
        std::string problem = rowProblem(row, 2, 1);  // reading the values would change their types
        ++report.chunks;
        const bool isTile = row.number(0) >= kFirstTileKey;
        if (isTile) ++report.tiles;
        if (!isTile && row.number(1) != 0) ++report.editedChunks;
        report.chunkBytes += row.blob(2).size();
        if (report.chunkBytes > report.fileBytes)
            return base::fail(base::ErrorCode::Damaged, "{}: damaged: chunks share pages",
                              file.database.path());
        if (problem.empty()) problem = problemOf(row, file);
        if (!problem.empty()) addDamage(report, posOf(row.number(0)), std::move(problem));
        return {};
    };
    return forEachRowInOrder(file.database, "SELECT key, origin, data FROM chunks ORDER BY key", check);
}

base::Result<void> countQuarantined(Database& database, CheckReport& report) {
    const auto count = [&](const Statement&) -> base::Result<void> {
        ++report.quarantined;
        return {};
    };
    return forEachRowInOrder(database, "SELECT number FROM quarantine ORDER BY number", count);
}

// Checks the index by name, which reading the blocks does not use.
base::Result<void> checkIndex(Database& database) {
    std::optional<std::string> last;
    const auto compare = [&](const Statement& row) -> base::Result<void> {
        std::string name(row.text(0));
        if (last && name <= *last)
            return base::fail(base::ErrorCode::Damaged, "{}: damaged: the index of blocks is out of order",
                              database.path());
        last = std::move(name);
        return {};
    };
    return forEachRow(database, "SELECT name FROM blocks INDEXED BY sqlite_autoindex_blocks_1 ORDER BY name",
                      compare);
}

// Reports an error that stops one check as damage; the other checks continue.
bool isGood(CheckReport& report, const base::Result<void>& checked) {
    if (!checked) report.fileProblems.push_back(checked.error().message);
    return checked.has_value();
}

std::uint64_t sizeOf(std::filesystem::path path, const char* ending) {
    path += ending;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

void checkLog(const std::string& path, CheckReport& report) {
    report.fileProblems = logProblems(path);
    if (std::string lost = lostLog(path); !lost.empty()) report.fileProblems.push_back(std::move(lost));
}

}  // namespace

void addDamage(CheckReport& report, world::ChunkPos pos, std::string problem) {
    if (report.damaged.size() < kMaxListedDamage) {
        report.damaged.push_back({pos, std::move(problem)});
    } else {
        ++report.unlisted;
    }
}

base::Result<CheckReport> checkSave(const std::filesystem::path& path, const world::BlockRegistry& registry) {
    CheckReport report;
    const auto measure = [&] { report.fileBytes = sizeOf(path, "") + sizeOf(path, "-wal"); };
    measure();
    auto file = openToRead(path, registry);
    if (!file) {
        if (file.error().code != base::ErrorCode::Damaged) return tl::unexpected(file.error());
        report.fileProblems.push_back(file.error().message);
        return report;
    }
    measure();  // the files do not shrink during the transaction
    report.inUse = file->inUse;
    report.format = file->format;
    report.identity = file->identity;
    report.unknownBlocks = file->ids.unknown();
    if (file->inUse.empty()) checkLog(file->database.path(), report);
    const bool hasChunks = isGood(report, checkChunks(*file, report));
    const bool hasQuarantine = isGood(report, countQuarantined(file->database, report));
    const bool hasIndex = isGood(report, checkIndex(file->database));
    if (hasChunks && hasQuarantine && hasIndex) isGood(report, checkPages(file->database, report));
    return report;
}

}  // namespace terrane::store
