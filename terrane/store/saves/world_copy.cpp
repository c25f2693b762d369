#include "terrane/store/saves/world_copy.h"

#include <charconv>
#include <limits>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/derived_rows.h"

namespace terrane::store {
namespace {

using base::ErrorCode;

// About 1 to 10 KB each.
constexpr std::size_t kRowsAtOnce = 512;
constexpr int kComparisons = 3;
constexpr std::string_view kFinished = "finished";
constexpr std::int64_t kBeforeAll = std::numeric_limits<std::int64_t>::min();

std::string unfinished(std::int64_t lastKey) {
    return std::string(kUnfinishedCopy) + std::to_string(lastKey);
}

// The last key of an unfinished copy; no value for other marks.
std::optional<std::int64_t> lastKeyOf(std::string_view mark) {
    if (!mark.starts_with(kUnfinishedCopy)) return std::nullopt;
    mark.remove_prefix(kUnfinishedCopy.size());
    std::int64_t key = 0;
    const auto [end, error] = std::from_chars(mark.data(), mark.data() + mark.size(), key);
    if (error != std::errc() || end != mark.data() + mark.size()) return std::nullopt;
    return key;
}

std::string problemOf(const KeyedRow& row, world::Heights heights) {
    if (!world::isInWorld(posOf(row.key))) return fmt::format("the key {} is not a position", row.key);
    if (!row.row.problem.empty()) return row.row.problem;
    const auto good = verifyChunk(row.row.data, heights, row.row.seed);
    return good ? std::string() : good.error().message;
}

// Reads the next valid rows of a world; counts invalid ones.
base::Result<std::vector<KeyedRow>> goodRowsAfter(ReadableRows& world, std::int64_t& key, bool& isEnd,
                                                  CopyReport& report) {
    auto rows = TERRANE_TRY(world.rowsAfter(key, kRowsAtOnce));
    isEnd = rows.empty();
    for (const KeyedRow& row : rows)
        if (row.row.seed != checksumSeed(posOf(row.key), row.row.provenance == Provenance::Edited))
            return base::fail(ErrorCode::Incompatible,
                              "{}: in an older format; it is migrated when it is opened for writing",
                              world.name());
    if (!rows.empty()) key = rows.back().key;
    std::erase_if(rows, [&](const KeyedRow& row) {
        const std::string problem = problemOf(row, world.identity().heights);
        if (problem.empty()) return false;
        if (report.damaged++ == 0)
            report.firstDamage = fmt::format("{}: {}", nameOf(posOf(row.key)), problem);
        return true;
    });
    return rows;
}

// Iterates over the rows of a world in groups.
class RowWalk {
  public:
    RowWalk(ReadableRows& world, CopyReport& report) : world_(world), report_(report) {}

    // Null at the end.
    base::Result<const KeyedRow*> current() {
        while (next_ == rows_.size() && !isEnd_) {
            auto rows = TERRANE_TRY(goodRowsAfter(world_, key_, isEnd_, report_));
            rows_ = std::move(rows);
            next_ = 0;
        }
        return next_ < rows_.size() ? &rows_[next_] : nullptr;
    }
    void step() { ++next_; }

  private:
    ReadableRows& world_;
    CopyReport& report_;
    std::vector<KeyedRow> rows_;
    std::size_t next_ = 0;
    std::int64_t key_ = kBeforeAll;
    bool isEnd_ = false;
};

void addTo(base::Digest& digest, const KeyedRow& row) {
    const auto origin = static_cast<std::uint8_t>(row.row.provenance);
    digest.update(std::as_bytes(std::span(&row.key, 1)));
    digest.update(std::as_bytes(std::span(&origin, 1)));
    digest.update(row.row.data);
}

bool isEqual(const KeyedRow& a, const KeyedRow& b) {
    return a.key == b.key && a.row.provenance == b.row.provenance && a.row.data == b.row.data;
}

class Copy {
  public:
    Copy(ReadableRows& from, ChunkRows& to, const RowsProgress& progress)
        : from_(from), to_(to), progress_(progress) {}

    base::Result<CopyReport> run(std::int64_t lastKey) {
        TERRANE_TRY(copyRows(lastKey));
        for (int time = 0; time < kComparisons; ++time) {
            const auto same = TERRANE_TRY(compare());
            if (!same) continue;
            TERRANE_TRY(to_.change(ending()));
            return report_;
        }
        return base::fail(ErrorCode::Busy,
                          "{}: it changes while it is copied; close the program that plays it", from_.name());
    }

  private:
    base::Result<void> goOn() {
        if (!progress_ || progress_(rows_)) return {};
        return base::fail(ErrorCode::Busy, "{}: the copy was stopped; start it again to continue",
                          to_.name());
    }

    base::Result<void> copyRows(std::int64_t lastKey) {
        for (bool isEnd = false; !isEnd;) {
            auto rows = TERRANE_TRY(goodRowsAfter(from_, lastKey, isEnd, report_));
            rows_ += rows.size();
            report_.copied += rows.size();
            RowChanges changes{std::move(rows), {}, {}};
            changes.metadata.emplace(kCopyMark, unfinished(lastKey));
            TERRANE_TRY(to_.change(changes));
            TERRANE_TRY(goOn());
        }
        return {};
    }

    // Whether both have the same rows; corrects differences.
    base::Result<bool> compare() {
        report_.rows = report_.bytes = report_.damaged = 0;
        base::Digest digest;
        CopyReport ignored;
        RowWalk source(from_, report_), target(to_, ignored);
        RowChanges changes;
        std::size_t changedBytes = 0;
        bool isSame = true;
        while (true) {
            const auto a = source.current(), b = target.current();
            if (!a || !b) return tl::unexpected((!a ? a : b).error());
            if (!*a && !*b) break;
            const bool isExtra = *b && (!*a || (*b)->key < (*a)->key);
            if (isExtra) {
                changes.deleted.push_back((*b)->key);
                target.step();
            } else {
                addTo(digest, **a);
                ++report_.rows;
                report_.bytes += (*a)->row.data.size();
                const bool isThere = *b && (*b)->key == (*a)->key;
                if (!isThere || !isEqual(**a, **b)) {
                    changes.rows.push_back(**a);
                    changedBytes += (*a)->row.data.size();
                }
                source.step();
                if (isThere) target.step();
            }
            if (changes.rows.size() + changes.deleted.size() >= kRowsAtOnce || changedBytes >= kBytesOfRows) {
                isSame = false;
                changedBytes = 0;
                TERRANE_TRY(repair(changes));
            }
            if (report_.rows % kRowsAtOnce == 0) TERRANE_TRY(goOn());
        }
        isSame &= changes.rows.empty() && changes.deleted.empty();
        TERRANE_TRY(repair(changes));
        report_.digest = digest.hex();
        return isSame;
    }

    base::Result<void> repair(RowChanges& changes) {
        report_.copied += changes.rows.size();
        auto done = to_.change(changes);
        changes = {};
        return done;
    }

    // The settings are written last, with the mark of tiles if no row was left out.
    RowChanges ending() const {
        RowChanges changes;
        changes.metadata = from_.metadata();
        changes.metadata.insert_or_assign(std::string(kCopyMark), std::string(kFinished));
        if (report_.damaged > 0) changes.metadata.erase(std::string(kDerivedRowsMark));
        return changes;
    }

    ReadableRows& from_;
    ChunkRows& to_;
    const RowsProgress& progress_;
    CopyReport report_;
    std::uint64_t rows_ = 0;
};

bool hasNames(const BlockIdMap& ids, const std::vector<SavedName>& names) {
    const std::vector<SavedName>& there = ids.names();
    if (there.size() < names.size()) return false;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (there[k].id != names[k].id || there[k].name != names[k].name) return false;
    return true;
}

}  // namespace

SaveAccess accessOfCopy(const ReadableRows& from) {
    SaveAccess access;
    access.create = from.identity();
    access.blockNames = from.ids().names();
    return access;
}

base::Result<std::int64_t> beginCopy(const ReadableRows& from, ChunkRows& to) {
    const auto source = from.metadata().find(kCopyMark);
    if (source != from.metadata().end() && lastKeyOf(source->second))
        return base::fail(ErrorCode::Incompatible, "{}: an unfinished copy; start it again", from.name());
    const auto mark = to.metadata().find(kCopyMark);
    const auto first = TERRANE_TRY(to.rowsAfter(kBeforeAll, 1));
    const bool isEmpty = mark == to.metadata().end() && first.empty();
    const auto lastKey = mark == to.metadata().end() ? std::nullopt : lastKeyOf(mark->second);
    if (!isEmpty && !lastKey)
        return base::fail(ErrorCode::Incompatible, "{}: there is a world already, {}", to.name(),
                          mark == to.metadata().end() ? "which is not a copy" : "a copy that was finished");
    TERRANE_TRY(requireSame(to.identity(), from.identity(), to.name()));
    if (!hasNames(to.ids(), from.ids().names()))
        return base::fail(ErrorCode::Incompatible, "{}: its block names are not those of {}", to.name(),
                          from.name());
    // Marks it as a copy even if nothing else gets written.
    if (isEmpty) {
        RowChanges begun;
        begun.metadata.emplace(kCopyMark, unfinished(kBeforeAll));
        TERRANE_TRY(to.change(begun));
    }
    return lastKey.value_or(kBeforeAll);
}

base::Result<CopyReport> copyWorld(ReadableRows& from, ChunkRows& to, std::int64_t lastKey,
                                   const RowsProgress& progress) {
    return Copy(from, to, progress).run(lastKey);
}

}  // namespace terrane::store
