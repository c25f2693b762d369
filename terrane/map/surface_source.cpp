#include "terrane/map/surface_source.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <unordered_map>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/map/lru_cache.h"
#include "terrane/map/surface_cache.h"

namespace terrane::map {

using world::ChunkPos;

bool EditedPositions::add(ChunkPos chunk) {
    base::require(chunk.level == 0, "EditedPositions::add: tiles follow from their chunks");
    for (auto& level : positions_) {
        if (!level.insert(chunk).second) return chunk.level > 0;
        chunk = {chunk.x >> 1, chunk.y >> 1, static_cast<std::uint8_t>(chunk.level + 1)};
    }
    return true;
}

bool EditedPositions::contains(ChunkPos chunk) const {
    return chunk.level <= world::kMaxLevel && positions_[chunk.level].contains(chunk);
}

std::vector<EditedChunk> EditedPositions::among(std::span<const ChunkPos> chunks) const {
    std::vector<EditedChunk> edited;
    for (const ChunkPos chunk : chunks)
        if (contains(chunk)) edited.push_back({chunk, nullptr});
    return edited;
}

namespace {

// Memory for generated chunks: those of 150 tiles, so that neighbors share the chunks at their borders.
constexpr std::size_t kMemoryBytes = std::size_t{64} << 20;
constexpr std::size_t kNoteBytes = 128;  // for an edited chunk that was not generated
constexpr int kBlobChunks = kBlobColumns / world::kChunkSize;

BlobPos blobOf(ChunkPos chunk) {
    static_assert(kBlobChunks == 16);
    return {chunk.x >> 4, chunk.y >> 4, chunk.level};
}

// The chunks of a blob, in the order of x + 16 y.
std::vector<ChunkPos> chunksOf(BlobPos blob) {
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < kBlobChunks * kBlobChunks; ++k)
        chunks.push_back(
            {blob.x * kBlobChunks + k % kBlobChunks, blob.y * kBlobChunks + k / kBlobChunks, blob.level});
    return chunks;
}

// The index of the first column of a row of a chunk in its blob.
std::size_t rowOfBlob(ChunkPos chunk, int row) {
    const auto x = static_cast<std::size_t>(chunk.x & 15), y = static_cast<std::size_t>(chunk.y & 15);
    return (y * world::kChunkSize + static_cast<std::size_t>(row)) * kBlobColumns + x * world::kChunkSize;
}

}  // namespace

using SurfaceMap = std::unordered_map<ChunkPos, SurfacePtr, world::ChunkPosHash>;

struct SurfaceSource::Impl {
    explicit Impl(const Parts& theParts) : parts(theParts) {}

    SurfacePtr remembered(ChunkPos pos) {
        const std::lock_guard lock(mutex);
        const SurfacePtr* found = surfaces.find(pos);
        return found ? *found : nullptr;
    }
    void remember(ChunkPos pos, const SurfacePtr& surface) {
        const std::lock_guard lock(mutex);
        surfaces.put(pos, surface, sizeof(Surface) + 128);
    }
    base::Result<SurfacePtr> generated(ChunkPos pos);
    // Surfaces of the edited ones of the chunks, by position; null if the store has none.
    base::Result<SurfaceMap> editedAmong(std::span<const ChunkPos> chunks,
                                         std::span<const EditedChunk> edited);
    base::Result<void> loadEdited(std::span<const ChunkPos> chunks, SurfaceMap& result);
    void noteEdited(const SurfaceMap& edited);
    void readBlobs(std::span<const ChunkPos> chunks);
    void readBlob(BlobPos blob);
    bool isWhole(BlobPos blob);
    void writeBlobs(std::span<const ChunkPos> chunks);
    void writeBlob(BlobPos blob);

    Parts parts;
    std::mutex mutex;  // guards the surfaces: as generated, null if edited
    LruCache<ChunkPos, SurfacePtr, world::ChunkPosHash> surfaces{kMemoryBytes};
};

base::Result<SurfacePtr> SurfaceSource::Impl::generated(ChunkPos pos) {
    if (SurfacePtr known = remembered(pos)) return known;
    const auto generator = TERRANE_TRY(parts.generators.at(pos.level));
    const auto surface = std::make_shared<const Surface>(surfaceOf(*generator, pos, parts.kinds));
    remember(pos, surface);
    return surface;
}

base::Result<SurfaceMap> SurfaceSource::Impl::editedAmong(std::span<const ChunkPos> chunks,
                                                          std::span<const EditedChunk> edited) {
    if (edited.empty()) return SurfaceMap();
    std::unordered_map<ChunkPos, const EditedChunk*, world::ChunkPosHash> editedAt;
    for (const EditedChunk& chunk : edited) editedAt[chunk.pos] = &chunk;
    SurfaceMap result;
    std::vector<ChunkPos> stored;
    for (const ChunkPos pos : chunks) {
        const auto found = editedAt.find(pos);
        if (found == editedAt.end() || !world::isInWorld(pos)) continue;
        const auto [at, isNew] = result.emplace(pos, nullptr);
        if (!isNew) continue;
        if (const world::ChunkPtr& live = found->second->chunk)
            at->second = std::make_shared<const Surface>(surfaceOf(*live, parts.kinds));
        else
            stored.push_back(pos);
    }
    TERRANE_TRY(loadEdited(stored, result));
    return result;
}

// Damaged chunks count as generated, as in a game. A chunk that could not be read may be intact: an error.
base::Result<void> SurfaceSource::Impl::loadEdited(std::span<const ChunkPos> chunks, SurfaceMap& result) {
    if (chunks.empty() || !parts.store) return {};
    const std::vector<store::LoadedChunk> loaded = parts.store->loadMany(chunks);
    for (std::size_t k = 0; k < chunks.size(); ++k) {
        if (loaded[k].isUnreadable && !loaded[k].isOverBudget)
            return base::fail(base::ErrorCode::Io, "{}: {}", store::nameOf(chunks[k]), loaded[k].problem);
        if (loaded[k].chunk)
            result[chunks[k]] = std::make_shared<const Surface>(surfaceOf(*loaded[k].chunk, parts.kinds));
    }
    return {};
}

// Notes edited chunks without generating them: writeBlob() does that once the rest of their blob is there.
void SurfaceSource::Impl::noteEdited(const SurfaceMap& edited) {
    const std::lock_guard lock(mutex);
    for (const auto& [pos, surface] : edited)
        if (!surfaces.contains(pos)) surfaces.put(pos, nullptr, kNoteBytes);
}

void SurfaceSource::Impl::readBlob(BlobPos blob) {
    const auto columns = parts.cache->find(blob);
    if (!columns) return;
    for (const ChunkPos chunk : chunksOf(blob)) {
        Surface surface;
        for (int row = 0; row < world::kChunkSize; ++row)
            std::copy_n(columns->begin() + static_cast<std::ptrdiff_t>(rowOfBlob(chunk, row)),
                        world::kChunkSize, surface.begin() + row * world::kChunkSize);
        remember(chunk, std::make_shared<const Surface>(surface));
    }
}

// Reads the blobs of chunks that are not in memory.
void SurfaceSource::Impl::readBlobs(std::span<const ChunkPos> chunks) {
    std::set<BlobPos> seen;
    for (const ChunkPos chunk : chunks)
        if (!seen.contains(blobOf(chunk)) && !remembered(chunk)) {
            seen.insert(blobOf(chunk));
            readBlob(blobOf(chunk));
        }
}

// Whether all chunks of the blob are in memory or noted as edited. Stops at the first that is not: some 10 µs
// at most.
bool SurfaceSource::Impl::isWhole(BlobPos blob) {
    const std::vector<ChunkPos> chunks = chunksOf(blob);
    const std::lock_guard lock(mutex);
    return std::ranges::all_of(chunks, [&](ChunkPos chunk) { return surfaces.contains(chunk); });
}

// Writes the blobs that these chunks have completed: a tile may have only some chunks of a blob.
void SurfaceSource::Impl::writeBlobs(std::span<const ChunkPos> chunks) {
    if (parts.cache->isBroken()) return;
    std::set<BlobPos> blobs;
    for (const ChunkPos chunk : chunks) blobs.insert(blobOf(chunk));
    for (const BlobPos blob : blobs)
        if (!parts.cache->contains(blob) && isWhole(blob)) writeBlob(blob);
}

// Writes nothing if a chunk cannot be generated.
void SurfaceSource::Impl::writeBlob(BlobPos blob) {
    std::vector<SurfaceColumn> columns(kColumnsOfBlob);
    for (const ChunkPos chunk : chunksOf(blob)) {
        const auto surface = generated(chunk);
        if (!surface) return;
        for (int row = 0; row < world::kChunkSize; ++row)
            std::copy_n((*surface)->begin() + row * world::kChunkSize, world::kChunkSize,
                        columns.begin() + static_cast<std::ptrdiff_t>(rowOfBlob(chunk, row)));
    }
    parts.cache->put(blob, columns);
}

SurfaceSource::SurfaceSource(const Parts& parts) : impl_(std::make_unique<Impl>(parts)) {}
SurfaceSource::~SurfaceSource() = default;

base::Result<std::vector<SurfacePtr>> SurfaceSource::surfaces(std::span<const ChunkPos> chunks,
                                                              std::span<const EditedChunk> edited) {
    static const auto kEmpty = std::make_shared<const Surface>();
    const auto asEdited = impl_->editedAmong(chunks, edited);
    if (!asEdited) return tl::unexpected(asEdited.error());
    if (impl_->parts.cache) impl_->readBlobs(chunks);
    std::vector<SurfacePtr> surfaces;
    for (const ChunkPos chunk : chunks) {
        if (!world::isInWorld(chunk)) {
            surfaces.push_back(kEmpty);
            continue;
        }
        const auto found = asEdited->find(chunk);
        auto surface =
            TERRANE_TRY(found != asEdited->end() && found->second ? base::Result<SurfacePtr>(found->second)
                                                                  : impl_->generated(chunk));
        surfaces.push_back(std::move(surface));
    }
    if (impl_->parts.cache) {
        impl_->noteEdited(*asEdited);
        impl_->writeBlobs(chunks);
    }
    return surfaces;
}

ColumnRect columnsOf(const world::ChunkArea& chunks, int level) {
    constexpr int kSize = world::kChunkSize;
    return {level, std::int64_t{chunks.x0} * kSize, std::int64_t{chunks.y0} * kSize,
            (chunks.x1 - chunks.x0) * kSize, (chunks.y1 - chunks.y0) * kSize};
}

ChunkPos chunkAt(std::int64_t x, std::int64_t y, int level) {
    constexpr std::int64_t kBeyond = std::int64_t{world::kMaxChunk} + 1;
    return {static_cast<std::int32_t>(std::clamp(x, -kBeyond - 1, kBeyond)),
            static_cast<std::int32_t>(std::clamp(y, -kBeyond - 1, kBeyond)),
            static_cast<std::uint8_t>(level)};
}

std::vector<ChunkPos> chunksTouching(const ColumnRect& rect) {
    const auto chunkOf = [](std::int64_t column) { return column >> 4; };
    std::vector<ChunkPos> chunks;
    for (std::int64_t y = chunkOf(rect.y0); y <= chunkOf(rect.y0 + rect.height - 1); ++y)
        for (std::int64_t x = chunkOf(rect.x0); x <= chunkOf(rect.x0 + rect.width - 1); ++x)
            chunks.push_back(chunkAt(x, y, rect.level));
    return chunks;
}

base::Result<SurfaceArea> SurfaceSource::area(const ColumnRect& rect, std::span<const EditedChunk> edited) {
    const std::vector<ChunkPos> chunks = chunksTouching(rect);
    const auto found = TERRANE_TRY(surfaces(chunks, edited));
    SurfaceArea area{rect, std::vector<SurfaceColumn>(static_cast<std::size_t>(rect.width) *
                                                      static_cast<std::size_t>(rect.height))};
    for (std::size_t k = 0; k < chunks.size(); ++k) copyChunk(rect, chunks[k], *found[k], area.columns);
    return area;
}

}  // namespace terrane::map
