#include "terrane/render/quads/light_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr int kTile = static_cast<int>(shared::kLightTileSize);
constexpr int kPoolTiles = static_cast<int>(shared::kLightPoolTiles);
constexpr int kTilesPerSlab = kPoolTiles * kPoolTiles;
constexpr std::size_t kSlabBytes = std::size_t{kTilesPerSlab} * 1024;
constexpr int kMaxSlabs = static_cast<int>((std::size_t{1} << 30) / kSlabBytes);  // 256: 1 GiB
// Light tiles of a chunk in a landscape, and bricks with several values; growing a pool that is too small
// takes a tenth of a second on software renderers.
constexpr int kTilesAChunk = 28, kBricksAChunk = 6;
constexpr std::size_t kTileBlocks = shared::kLightTileSize * shared::kLightTileSize * shared::kLightTileSize;

constexpr std::size_t kMiddle = kTile / 2 * (1 + kTile + kTile * kTile);

using TileValues = std::array<std::uint16_t, kTileBlocks>;

// Red and blue are swapped on upload and when sampled: drivers keep four bits a component with blue lowest,
// where light::LightValue has red. A driver that has to reorder texels takes four times as long for an
// upload.
gpu::Texture3D makePool(int slabs) {
    gpu::Texture3D pool({kPoolTiles * kTile, kPoolTiles * kTile, slabs * kTile}, GL_RGBA4, "light pool");
    glTextureParameteri(pool.id(), GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    glTextureParameteri(pool.id(), GL_TEXTURE_SWIZZLE_B, GL_RED);
    return pool;
}

int chunksWithin(int viewDistance) {
    return (2 * viewDistance + 1) * (2 * viewDistance + 1);
}

int slabsOfDriver() {
    GLint texels = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &texels);
    return std::min(texels / kTile, kMaxSlabs);
}

// Light tile (x, y, z), 0 or 1 each, of an unpacked brick of 16³.
TileValues tileOf(const std::array<std::uint16_t, world::kBlocksPerSection>& brick, int x, int y, int z) {
    TileValues tile;
    auto* to = tile.data();
    for (int row = 0; row < kTile * kTile; ++row) {
        const int by = y * kTile + row % kTile, bz = z * kTile + row / kTile;
        to = std::copy_n(brick.data() + x * kTile + 16 * by + 256 * bz, kTile, to);
    }
    return tile;
}

bool isUniform(std::uint32_t entry) {
    return (entry & shared::kLightUniformBit) != 0;
}

}  // namespace

LightStore::LightStore(int viewDistance, int maxSlabs, std::size_t maxBytes, world::Heights heights)
    : heights_(heights), maxSlabs_(maxSlabs > 0 ? maxSlabs : slabsOfDriver()), maxBytes_(maxBytes) {
    gridChunks_ = static_cast<int>(std::bit_ceil(static_cast<unsigned>(2 * (viewDistance + 2) + 1)));
    shown_.resize(static_cast<std::size_t>(gridChunks_) * static_cast<std::size_t>(gridChunks_));
    grid_ = gpu::Texture3D({gridChunks_, gridChunks_, heights.sections()}, GL_R32UI, "light grid");
    const shared::uint unknown = shared::kLightUnknown;
    glClearTexImage(grid_.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &unknown);
    const int chunks = chunksWithin(viewDistance);
    growEntries(static_cast<std::size_t>(chunks * kBricksAChunk));
    const int slabs = (chunks * kTilesAChunk + kTilesPerSlab - 1) / kTilesPerSlab;
    pool_ = makePool(std::min({slabs, maxSlabs_, std::max(1, slabsWithin(maxBytes_))}));
}

// Slabs that fit beside the existing textures.
int LightStore::slabsWithin(std::size_t bytes) const {
    const std::size_t room = bytes - std::min(bytes, textureBytes());
    return static_cast<int>(std::min<std::size_t>(room / kSlabBytes, kMaxSlabs));
}

int LightStore::slabs() const {
    return pool_.size().z / kTile;
}

std::optional<std::uint32_t> LightStore::allocateTile() {
    if (!freeTiles_.empty()) {
        const std::uint32_t tile = freeTiles_.back();
        freeTiles_.pop_back();
        return tile;
    }
    const bool isFull = tileCount_ == static_cast<std::size_t>(slabs()) * kTilesPerSlab;
    if (isFull && !growPool()) return std::nullopt;
    return static_cast<std::uint32_t>(tileCount_++);
}

// The GPU copies; pending draws keep the old texture alive.
bool LightStore::growPool() {
    const int grown = std::min({2 * slabs(), maxSlabs_, slabsWithin(maxBytes_)});
    if (grown <= slabs()) return false;
    const glm::ivec3 size = pool_.size();
    gpu::Texture3D larger = makePool(grown);
    peakBytes_ = std::max(peakBytes_, textureBytes() + larger.sizeBytes());
    glCopyImageSubData(pool_.id(), GL_TEXTURE_3D, 0, 0, 0, 0, larger.id(), GL_TEXTURE_3D, 0, 0, 0, 0, size.x,
                       size.y, size.z);
    pool_ = std::move(larger);
    return true;
}

void LightStore::uploadTile(std::uint32_t tile, std::span<const std::uint16_t> values) {
    const auto n = static_cast<int>(tile);
    const glm::ivec3 at{n % kPoolTiles, n / kPoolTiles % kPoolTiles, n / kTilesPerSlab};
    pool_.uploadPart(at * kTile, glm::ivec3(kTile), GL_BGRA, GL_UNSIGNED_SHORT_4_4_4_4_REV,
                     std::as_bytes(values));
    ++uploadedTiles_;
}

std::optional<std::uint32_t> LightStore::allocateEntries() {
    if (!freeBricks_.empty()) {
        const std::uint32_t number = freeBricks_.back();
        freeBricks_.pop_back();
        return number;
    }
    const std::size_t bricks = brickEntries_.size();
    const bool isFull = entries_.sizeBytes() == bricks * sizeof(BrickEntries);
    if (isFull && !growEntries(2 * bricks)) return std::nullopt;
    brickEntries_.emplace_back();
    return static_cast<std::uint32_t>(bricks);
}

// Pending draws keep the old buffer alive.
bool LightStore::growEntries(std::size_t bricks) {
    const std::size_t bytes = bricks * sizeof(BrickEntries), before = textureBytes();
    const bool isWithin = before <= maxBytes_ && bytes <= maxBytes_ - before;
    if (!brickEntries_.empty() && !isWithin) return false;
    if (bricks * std::tuple_size_v < BrickEntries >> gpu::BufferTexture::maxElements()) return false;
    peakBytes_ = std::max(peakBytes_, before + bytes);
    entries_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "light entries");
    entryTexels_ = gpu::BufferTexture(entries_, GL_R32UI, "light entries");
    if (!brickEntries_.empty()) entries_.uploadVector(0, brickEntries_);
    return true;
}

std::size_t LightStore::placeOf(world::ChunkPos pos) const {
    const int mask = gridChunks_ - 1;
    return static_cast<std::size_t>((pos.y & mask) * gridChunks_ + (pos.x & mask));
}

void LightStore::uploadColumn(world::ChunkPos pos, const Column& column) {
    const int mask = gridChunks_ - 1;
    grid_.uploadPart({pos.x & mask, pos.y & mask, 0}, {1, 1, heights_.sections()}, GL_RED_INTEGER,
                     GL_UNSIGNED_INT, std::as_bytes(std::span(column)));
}

LightStore::Column LightStore::unknownColumn() const {
    return Column(static_cast<std::size_t>(heights_.sections()), shared::kLightUnknown);
}

void LightStore::releaseTiles(const BrickEntries& entries) {
    for (const std::uint32_t entry : entries)
        if (!isUniform(entry)) freeTiles_.push_back(entry);
}

void LightStore::release(std::uint32_t entry) {
    if (isUniform(entry)) return;
    releaseTiles(brickEntries_[entry]);
    freeBricks_.push_back(entry);
}

bool LightStore::setBrick(std::uint32_t& entry, const light::LightBrick& brick) {
    if (brick.isUniform()) {
        release(entry);
        entry = shared::kLightUniformBit | brick.uniformValue();
        return true;
    }
    if (isUniform(entry)) {
        const auto number = allocateEntries();
        if (!number) {
            entry = shared::kLightUniformBit |
                    brick.get(world::kBlocksPerSection / 2 + world::kChunkSize * 8 + 8);
            return false;
        }
        entry = *number;
    } else {
        releaseTiles(brickEntries_[entry]);
    }
    const bool hasRoom = setTiles(brickEntries_[entry], brick);
    entries_.upload(entry * sizeof(BrickEntries), std::as_bytes(std::span(brickEntries_[entry])));
    return hasRoom;
}

bool LightStore::setTiles(BrickEntries& entries, const light::LightBrick& brick) {
    bool hasRoom = true;
    std::array<std::uint16_t, world::kBlocksPerSection> unpacked;
    brick.unpack(unpacked);
    for (int k = 0; k < static_cast<int>(kTilesPerBrick); ++k) {
        const TileValues values = tileOf(unpacked, k & 1, k >> 1 & 1, k >> 2);
        const auto differs = [&](std::uint16_t v) { return v != values[0]; };
        std::uint32_t& entry = entries[static_cast<std::size_t>(k)];
        if (std::none_of(values.begin(), values.end(), differs)) {
            entry = shared::kLightUniformBit | values[0];
            continue;
        }
        const auto tile = allocateTile();
        entry = tile.value_or(shared::kLightUniformBit | values[kMiddle]);
        hasRoom &= tile.has_value();
        if (tile) uploadTile(*tile, values);
    }
    return hasRoom;
}

bool LightStore::set(world::ChunkPos pos, const light::ChunkLight& light, const world::SectionSet& bricks) {
    TERRANE_ZONE("upload light");
    base::require(pos.level == 0, "Renderer::setLight: only chunks of level 0 have light");
    base::require(light.heights() == heights_,
                  "Renderer::setLight: the light has other heights than the world: see Renderer::setHeights");
    const auto [it, isNew] = chunks_.try_emplace(pos);
    Column& column = it->second;
    if (isNew) column = unknownColumn();
    bool hasRoom = true;
    for (std::size_t k = 0; k < column.size(); ++k) {
        const int number = heights_.firstSection() + static_cast<int>(k);
        if (isNew || bricks.has(number)) hasRoom &= setBrick(column[k], light.brick(number));
    }
    uploadColumn(pos, column);
    shown_[placeOf(pos)] = pos;
    return hasRoom;
}

void LightStore::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    for (const std::uint32_t entry : found->second) release(entry);
    chunks_.erase(found);
    // Keeps the entries of a chunk that took the place meanwhile.
    std::optional<world::ChunkPos>& shown = shown_[placeOf(pos)];
    if (shown != pos) return;
    shown.reset();
    uploadColumn(pos, unknownColumn());
}

void LightStore::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kLightGridUnit, grid_.id())
        .add(shared::kLightEntriesUnit, entryTexels_.id())
        .add(shared::kLightPoolUnit, pool_.id());
}

}  // namespace terrane::render
