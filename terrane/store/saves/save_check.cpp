#include "terrane/store/saves/save_check.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <system_error>
#include <utility>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/chunk_reader.h"

namespace terrane::store {

namespace {

// SQLite's file format, section 4: "The Write-Ahead Log".
constexpr std::size_t kLogHeaderBytes = 32, kFrameHeaderBytes = 24;
constexpr std::uint32_t kLogMagic = 0x377f0682;  // its lowest bit: words of checksums are big-endian
constexpr std::uint32_t kMinPage = 512, kMaxPage = 65536;

using LogBytes = std::span<const unsigned char>;

std::uint32_t wordAt(LogBytes bytes, std::size_t at, bool isBigEndian = true) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | bytes[at + (isBigEndian ? k : 3 - k)];
    return value;
}

struct Checksum {
    bool isBigEndian = false;
    std::uint32_t low = 0, high = 0;

    void add(LogBytes bytes) {
        for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
            low += wordAt(bytes, at, isBigEndian) + high;
            high += wordAt(bytes, at + 4, isBigEndian) + low;
        }
    }
    bool isAt(LogBytes bytes, std::size_t at) const {
        return wordAt(bytes, at) == low && wordAt(bytes, at + 4) == high;
    }
};

bool isPageSize(std::uint32_t bytes) {
    return bytes >= kMinPage && bytes <= kMaxPage && (bytes & (bytes - 1)) == 0;
}

// Frames of this log, identified by their salts: frames from before a restart of the log have others.
struct Frames {
    std::size_t whole = 0;          // intact frames from the first on
    std::size_t commitsBehind = 0;  // commits after the first broken frame
    bool isBroken = false;
};

Frames readFrames(std::istream& log, LogBytes header, Checksum sum, std::uint32_t pageBytes) {
    Frames frames;
    std::vector<unsigned char> frame(kFrameHeaderBytes + pageBytes);
    while (log.read(reinterpret_cast<char*>(frame.data()), static_cast<std::streamsize>(frame.size()))) {
        const LogBytes bytes(frame);
        const bool isOfThisLog =
            wordAt(bytes, 8) == wordAt(header, 16) && wordAt(bytes, 12) == wordAt(header, 20);
        sum.add(bytes.first(8));
        sum.add(bytes.subspan(kFrameHeaderBytes));
        frames.isBroken = frames.isBroken || !isOfThisLog || !sum.isAt(bytes, 16);
        const bool isCommit = wordAt(bytes, 4) != 0;
        if (!frames.isBroken) ++frames.whole;
        if (frames.isBroken && isOfThisLog && isCommit) ++frames.commitsBehind;
    }
    return frames;
}

}  // namespace

std::vector<std::string> logProblems(const std::filesystem::path& save) {
    std::filesystem::path path = save;
    path += "-wal";
    std::ifstream log(path, std::ios::binary);
    std::array<unsigned char, kLogHeaderBytes> header{};
    if (!log.read(reinterpret_cast<char*>(header.data()), header.size())) return {};
    const std::uint32_t magic = wordAt(header, 0), pageBytes = wordAt(header, 8);
    Checksum sum{.isBigEndian = (magic & 1) != 0};
    sum.add(LogBytes(header).first(24));
    // SQLite syncs the header before it writes the first frame: a power failure before that leaves a torn
    // header and no transactions.
    const bool isWhole = (magic & ~1u) == kLogMagic && isPageSize(pageBytes) && sum.isAt(header, 24);
    if (!isWhole) {
        return {
            fmt::format("{}: its header is broken: all that it holds is lost, unless it was never finished",
                        path.string())};
    }
    const Frames frames = readFrames(log, header, sum, pageBytes);
    if (frames.commitsBehind == 0) return {};
    // Each transaction is on disk before the next one is written; only the last one may be partial after a
    // power failure.
    const std::string lost = frames.commitsBehind == 1
                                 ? "the last transaction is lost, unless it was never finished"
                                 : fmt::format("{} transactions are lost", frames.commitsBehind);
    return {fmt::format("{}: broken behind frame {}: {}", path.string(), frames.whole, lost)};
}

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
    const auto chunk = decodeChunk(row.blob(2), file.ids, file.identity.heights, seed);
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

// Reports an error that stops one check as damage; the other checks continue. Without memory all of them end.
base::Result<bool> isGood(CheckReport& report, const base::Result<void>& checked) {
    if (checked) return true;
    if (checked.error().code == base::ErrorCode::OutOfResources) return tl::unexpected(checked.error());
    report.fileProblems.push_back(checked.error().message);
    return false;
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
    const bool hasChunks = TERRANE_TRY(isGood(report, checkChunks(*file, report)));
    const bool hasQuarantine = TERRANE_TRY(isGood(report, countQuarantined(file->database, report)));
    const bool hasIndex = TERRANE_TRY(isGood(report, checkIndex(file->database)));
    if (hasChunks && hasQuarantine && hasIndex)
        TERRANE_TRY(isGood(report, checkPages(file->database, report)));
    return report;
}

}  // namespace terrane::store
