#include "terrane/map/surface_cache.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/file_lock.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::map {

namespace {

// A column is four numbers of two bytes in eight planes, one plane after the other, which zstd makes small:
// the height as the difference to a prediction from its neighbors, the depth beneath it, the top block's id,
// and the difference of the lower block's id, which is 0 nearly everywhere on land.
enum Plane { HeightLow, HeightHigh, DepthLow, DepthHigh, TopLow, TopHigh, UnderLow, UnderHigh };
static_assert(UnderHigh + 1 == kColumnPlanes);
constexpr std::size_t kPlaneBytes = kColumnsOfBlob, kRawBytes = kColumnPlanes * kPlaneBytes;

// The prediction from earlier columns: in a plane each height is west + south - southwest.
template <class HeightAt>
int predictedHeight(std::size_t k, HeightAt heightAt) {
    const bool hasWest = k % kBlobColumns != 0, hasSouth = k >= kBlobColumns;
    if (hasWest && hasSouth)
        return heightAt(k - 1) + heightAt(k - kBlobColumns) - heightAt(k - kBlobColumns - 1);
    if (hasWest) return heightAt(k - 1);
    return hasSouth ? heightAt(k - kBlobColumns) : 0;
}

std::uint64_t checksum(store::ByteView bytes) {
    return base::hash64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::uint8_t low(unsigned value) {
    return static_cast<std::uint8_t>(value & 0xFF);
}
std::uint8_t high(unsigned value) {
    return static_cast<std::uint8_t>(value >> 8 & 0xFF);
}

}  // namespace

store::Bytes encodeSurfaces(std::span<const SurfaceColumn> columns) {
    std::vector<std::uint8_t> raw(kRawBytes);
    const auto plane = [&](Plane p, std::size_t k) -> std::uint8_t& { return raw[p * kPlaneBytes + k]; };
    for (std::size_t k = 0; k < kColumnsOfBlob; ++k) {
        const SurfaceColumn& column = columns[k];
        const auto height = [&](std::size_t n) { return static_cast<int>(columns[n].topZ); };
        const auto put = [&](Plane lowPlane, int value) {
            plane(lowPlane, k) = low(static_cast<unsigned>(value));
            plane(static_cast<Plane>(lowPlane + 1), k) = high(static_cast<unsigned>(value));
        };
        put(HeightLow, column.topZ - predictedHeight(k, height));
        put(DepthLow, column.topZ - column.underZ);
        put(TopLow, column.top);
        put(UnderLow, column.under - column.top);
    }
    store::Bytes bytes;
    store::appendNumber(bytes, checksum(std::as_bytes(std::span(raw))));
    store::appendCompressed(bytes, std::as_bytes(std::span(raw)));
    return bytes;
}

base::Result<std::vector<SurfaceColumn>> decodeSurfaces(store::ByteView bytes) {
    store::ByteReader reader(bytes);
    const auto expected = reader.number<std::uint64_t>();
    std::vector<std::uint8_t> raw(kRawBytes);
    TERRANE_TRY(store::decompress(reader.rest(), std::as_writable_bytes(std::span(raw))));
    if (checksum(std::as_bytes(std::span(raw))) != expected)
        return base::fail(base::ErrorCode::Damaged, "surfaces: wrong checksum");
    std::vector<SurfaceColumn> columns(kColumnsOfBlob);
    // The number of two planes; sums of it wrap at 16 bits.
    const auto number = [&](Plane lowPlane, std::size_t k) {
        return raw[lowPlane * kPlaneBytes + k] | raw[(lowPlane + 1) * kPlaneBytes + k] << 8;
    };
    for (std::size_t k = 0; k < kColumnsOfBlob; ++k) {
        const auto height = [&](std::size_t n) { return static_cast<int>(columns[n].topZ); };
        SurfaceColumn& column = columns[k];
        column.topZ = static_cast<std::int16_t>(number(HeightLow, k) + predictedHeight(k, height));
        column.underZ = static_cast<std::int16_t>(column.topZ - number(DepthLow, k));
        column.top = static_cast<world::BlockId>(number(TopLow, k));
        column.under = static_cast<world::BlockId>(column.top + number(UnderLow, k));
    }
    return columns;
}

namespace {

// The version of surfaces and rows: files of another version are replaced.
constexpr std::string_view kForm = "3";

// The share of the file's bytes that rows may take. The rest is for pages of SQLite's own: the schema and the
// inner pages of the tables.
constexpr double kFilled = 0.9;

// The first number of a use, so that each number takes 8 bytes in a row: SQLite updates a row in place if its
// size stays, and else writes all of it elsewhere.
constexpr std::int64_t kFirstUse = std::int64_t{1} << 48;

// A row's bytes in the file, in whole pages, since it may leave half of its last page empty. (Rows of 2.5 KB
// took 1.6 times their bytes.)
constexpr std::int64_t kPageBytes = 4096, kRowHeadBytes = 32;
std::int64_t roomOf(std::int64_t blobBytes) {
    return ((blobBytes + kRowHeadBytes) / kPageBytes + 1) * kPageBytes;
}

// Settings of a connection. The file need not survive a crash: a damaged one is replaced.
constexpr const char* kSettings =
    "PRAGMA page_size = 4096; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA locking_mode = "
    "EXCLUSIVE;";
constexpr const char* kSchema =
    "CREATE TABLE IF NOT EXISTS origin (text TEXT NOT NULL);"
    "CREATE TABLE IF NOT EXISTS surfaces (key INTEGER PRIMARY KEY, used INTEGER NOT NULL, bytes BLOB NOT "
    "NULL);";

std::int64_t keyOf(BlobPos pos) {
    return store::keyOf({pos.x, pos.y, pos.level});
}

std::string originOf(const std::string& origin) {
    return fmt::format("{} {}", kForm, origin);
}

base::Result<bool> hasNoSurfaces(store::Database& database) {
    bool isEmpty = true;
    TERRANE_TRY(store::forEachRow(database, "SELECT 1 FROM surfaces LIMIT 1", [&](const store::Statement&) {
        isEmpty = false;
        return base::Result<void>();
    }));
    return isEmpty;
}

// SQLite keeps the pages of deleted rows, so a file never shrinks.
void removeWhereLarger(const std::filesystem::path& file, std::int64_t maxBytes) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(file, error);
    if (!error && bytes > static_cast<std::uintmax_t>(maxBytes)) std::filesystem::remove(file, error);
}

// A connection to a file of this origin; an error if it is another kind of file or has another origin.
base::Result<store::Database> openFile(const std::filesystem::path& file, const std::string& origin) {
    auto database = TERRANE_TRY(store::Database::open(file, store::OpenMode::Create));
    TERRANE_TRY(database.execute(kSettings));
    TERRANE_TRY(database.execute(kSchema));
    std::string found;
    TERRANE_TRY(store::forEachRow(database, "SELECT text FROM origin", [&](const store::Statement& row) {
        found = row.text(0);
        return base::Result<void>();
    }));
    if (found == origin) return database;
    if (!found.empty())
        return base::fail(base::ErrorCode::Incompatible, "{}: of another world", file.string());
    const auto empty = TERRANE_TRY(hasNoSurfaces(database));
    if (!empty)
        return base::fail(base::ErrorCode::Incompatible, "{}: does not name its world", file.string());
    auto insert = TERRANE_TRY(database.prepare("INSERT INTO origin VALUES (?)"));
    insert.bind(1, std::string_view(origin));
    TERRANE_TRY(insert.run());
    return database;
}

// Whether a new file in this place would not have the error.
bool isOtherFile(const base::Error& error) {
    using enum base::ErrorCode;
    return error.code == Incompatible || error.code == Damaged || error.code == Failed;
}

}  // namespace

struct SurfaceCache::Impl {
    Impl(store::Database opened, std::int64_t most) : database(std::move(opened)), maxBytes(most) {}

    static base::Result<std::unique_ptr<Impl>> open(const std::filesystem::path& file,
                                                    const std::string& origin, std::int64_t maxBytes);
    base::Result<void> prepare();
    base::Result<void> write(std::int64_t key, store::ByteView bytes);
    base::Result<void> forget(std::int64_t key);
    void noteUse(std::int64_t key);
    void check(const base::Result<void>& done);
    void keepUses();

    struct Row {
        std::int64_t used = 0, bytes = 0;  // of the file
    };
    std::optional<store::FileLock> lock;  // ends after the database
    std::mutex mutex;                     // guards all below
    store::Database database;
    std::optional<store::Statement> select, insert, remove;
    std::int64_t maxBytes, bytes = 0;
    std::int64_t uses = kFirstUse;               // of the newest one
    std::unordered_map<std::int64_t, Row> rows;  // by key
    std::map<std::int64_t, std::int64_t> byUse;  // keys
    bool isBroken = false;                       // nothing is written any more
};

base::Result<void> SurfaceCache::Impl::prepare() {
    TERRANE_TRY(store::forEachRow(database, "SELECT key, length(bytes) FROM surfaces ORDER BY used",
                                  [&](const store::Statement& row) {
                                      rows[row.number(0)] = {++uses, roomOf(row.number(1))};
                                      byUse[uses] = row.number(0);
                                      bytes += roomOf(row.number(1));
                                      return base::Result<void>();
                                  }));
    const auto make = [&](std::optional<store::Statement>& statement, std::string_view sql) {
        auto made = database.prepare(sql);
        if (made) statement.emplace(std::move(*made));
        return made ? base::Result<void>() : tl::unexpected(made.error());
    };
    TERRANE_TRY(make(select, "SELECT bytes FROM surfaces WHERE key = ?"));
    TERRANE_TRY(make(insert, "INSERT OR REPLACE INTO surfaces VALUES (?, ?, ?)"));
    return make(remove, "DELETE FROM surfaces WHERE key = ?");
}

void SurfaceCache::Impl::noteUse(std::int64_t key) {
    Row& row = rows.at(key);
    byUse.erase(row.used);
    row.used = ++uses;
    byUse[uses] = key;
}

base::Result<void> SurfaceCache::Impl::forget(std::int64_t key) {
    const auto found = rows.find(key);
    if (found == rows.end()) return {};
    bytes -= found->second.bytes;
    byUse.erase(found->second.used);
    rows.erase(found);
    remove->bind(1, key);
    return remove->run();
}

base::Result<void> SurfaceCache::Impl::write(std::int64_t key, store::ByteView blob) {
    const std::int64_t size = roomOf(static_cast<std::int64_t>(blob.size()));
    const auto most = static_cast<std::int64_t>(static_cast<double>(maxBytes) * kFilled);
    TERRANE_TRY(forget(key));
    while (!byUse.empty() && bytes + size > most) TERRANE_TRY(forget(byUse.begin()->second));
    if (size > most) return {};
    insert->bind(1, key);
    insert->bind(2, ++uses);
    insert->bind(3, blob);
    TERRANE_TRY(insert->run());
    rows[key] = {uses, size};
    byUse[uses] = key;
    bytes += size;
    return {};
}

void SurfaceCache::Impl::check(const base::Result<void>& done) {
    if (done || isBroken) return;
    isBroken = true;
    base::logWarning("{}; the map keeps nothing on disk any more", done.error().message);
}

// Stores the order of uses for the next run.
void SurfaceCache::Impl::keepUses() {
    auto transaction = store::Transaction::begin(database);
    if (!transaction) return check(tl::unexpected(transaction.error()));
    auto update = database.prepare("UPDATE surfaces SET used = ? WHERE key = ?");
    if (!update) return check(tl::unexpected(update.error()));
    for (const auto& [use, key] : byUse) {
        update->bind(1, use);
        update->bind(2, key);
        if (auto written = update->run(); !written) return check(written);
    }
    check(transaction->commit());
}

base::Result<std::unique_ptr<SurfaceCache::Impl>> SurfaceCache::Impl::open(const std::filesystem::path& file,
                                                                           const std::string& origin,
                                                                           std::int64_t maxBytes) {
    auto database = TERRANE_TRY(openFile(file, originOf(origin)));
    auto impl = std::make_unique<Impl>(std::move(database), maxBytes);
    TERRANE_TRY(impl->prepare());
    return impl;
}

base::Result<std::unique_ptr<SurfaceCache>> SurfaceCache::open(const std::filesystem::path& file,
                                                               const std::string& origin,
                                                               std::int64_t maxBytes) {
    // SQLite's own lock would let two programs read, until one of them writes.
    auto lock = TERRANE_TRY(store::FileLock::acquire(file, store::FileLock::Kind::Exclusive));
    removeWhereLarger(file, maxBytes);
    auto impl = Impl::open(file, origin, maxBytes);
    if (!impl && isOtherFile(impl.error())) {
        std::error_code error;
        std::filesystem::remove(file, error);
        impl = Impl::open(file, origin, maxBytes);
    }
    if (!impl) return tl::unexpected(impl.error());
    (*impl)->lock = std::move(lock);
    return std::unique_ptr<SurfaceCache>(new SurfaceCache(std::move(*impl)));
}

SurfaceCache::SurfaceCache(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

SurfaceCache::~SurfaceCache() {
    if (!impl_->isBroken) impl_->keepUses();
}

bool SurfaceCache::contains(BlobPos pos) const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->rows.contains(keyOf(pos));
}

std::optional<std::vector<SurfaceColumn>> SurfaceCache::find(BlobPos pos) {
    const std::int64_t key = keyOf(pos);
    store::Bytes bytes;
    {
        const std::lock_guard lock(impl_->mutex);
        if (!impl_->rows.contains(key)) return std::nullopt;
        impl_->noteUse(key);
        const store::ResetGuard reset(*impl_->select);
        impl_->select->bind(1, key);
        const auto row = impl_->select->step();
        if (row && *row) {
            const store::ByteView blob = impl_->select->blob(0);
            bytes.assign(blob.begin(), blob.end());
        }
    }
    auto columns = decodeSurfaces(bytes);
    if (columns) return std::move(*columns);
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->isBroken) impl_->check(impl_->forget(key));
    return std::nullopt;
}

void SurfaceCache::put(BlobPos pos, std::span<const SurfaceColumn> columns) {
    if (isBroken()) return;
    const store::Bytes bytes = encodeSurfaces(columns);
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->isBroken) impl_->check(impl_->write(keyOf(pos), bytes));
}

bool SurfaceCache::isBroken() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->isBroken;
}

std::int64_t SurfaceCache::bytes() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->bytes;
}

}  // namespace terrane::map
