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
// Light tiles of a chunk in a landscape; growing a pool that is too small takes a tenth of a second on
// software renderers.
constexpr int kTilesAChunk = 28;
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

int slabsFor(int viewDistance) {
    const int side = 2 * viewDistance + 1;
    return (side * side * kTilesAChunk + kTilesPerSlab - 1) / kTilesPerSlab;
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

// Entries of a whole chunk. Light tiles are ordered by brick: the eight of a brick are consecutive.
constexpr auto filled(std::uint32_t entry) {
    std::array<std::uint32_t, shared::kLightTilesPerChunk> entries{};
    entries.fill(entry);
    return entries;
}

}  // namespace

LightStore::LightStore(int viewDistance, int maxSlabs, std::size_t maxBytes)
    : maxSlabs_(maxSlabs > 0 ? maxSlabs : slabsOfDriver()), maxBytes_(maxBytes) {
    gridChunks_ = static_cast<int>(std::bit_ceil(static_cast<unsigned>(2 * (viewDistance + 2) + 1)));
    shown_.resize(static_cast<std::size_t>(gridChunks_) * static_cast<std::size_t>(gridChunks_));
    const int side = 2 * gridChunks_, high = static_cast<int>(shared::kLightTilesHigh);
    grid_ = gpu::Texture3D({side, side, high}, GL_R32UI, "light grid");
    const shared::uint unknown = shared::kLightUnknown;
    glClearTexImage(grid_.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &unknown);
    pool_ = makePool(std::min({slabsFor(viewDistance), maxSlabs_, std::max(1, slabsWithin(maxBytes_))}));
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
    if (!free_.empty()) {
        const std::uint32_t tile = free_.back();
        free_.pop_back();
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
    peakBytes_ = textureBytes() + larger.sizeBytes();
    glCopyImageSubData(pool_.id(), GL_TEXTURE_3D, 0, 0, 0, 0, larger.id(), GL_TEXTURE_3D, 0, 0, 0, 0, size.x,
                       size.y, size.z);
    pool_ = std::move(larger);
    return true;
}

void LightStore::uploadTile(std::uint32_t tile, const std::uint16_t* values) {
    const auto n = static_cast<int>(tile);
    const glm::ivec3 at{n % kPoolTiles, n / kPoolTiles % kPoolTiles, n / kTilesPerSlab};
    pool_.uploadPart(at * kTile, glm::ivec3(kTile), GL_BGRA, GL_UNSIGNED_SHORT_4_4_4_4_REV,
                     std::as_bytes(std::span(values, kTileBlocks)));
    ++uploadedTiles_;
}

std::size_t LightStore::placeOf(world::ChunkPos pos) const {
    const int mask = gridChunks_ - 1;
    return static_cast<std::size_t>((pos.y & mask) * gridChunks_ + (pos.x & mask));
}

void LightStore::uploadEntries(world::ChunkPos pos, const Entries& entries) {
    const int mask = gridChunks_ - 1;
    grid_.uploadPart({2 * (pos.x & mask), 2 * (pos.y & mask), 0}, {2, 2, shared::kLightTilesHigh},
                     GL_RED_INTEGER, GL_UNSIGNED_INT, std::as_bytes(std::span(entries)));
}

void LightStore::release(std::span<const std::uint32_t> entries) {
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(free_),
                 [](std::uint32_t entry) { return (entry & shared::kLightUniformBit) == 0; });
}

bool LightStore::setBrick(std::span<std::uint32_t, kTilesPerBrick> entries, const light::LightBrick& brick) {
    bool hasRoom = true;
    release(entries);
    if (brick.isUniform()) {
        std::fill(entries.begin(), entries.end(), shared::kLightUniformBit | brick.uniformValue());
        return true;
    }
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
        if (tile) uploadTile(*tile, values.data());
        hasRoom &= tile.has_value();
    }
    return hasRoom;
}

bool LightStore::set(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks) {
    TERRANE_ZONE("upload light");
    base::require(pos.level == 0, "Renderer::setLight: only chunks of level 0 have light");
    const auto [it, isNew] = chunks_.try_emplace(pos, filled(shared::kLightUnknown));
    const std::span entries(it->second);
    bool hasRoom = true;
    for (int n = 0; n < world::kSectionsPerChunk; ++n) {
        if (!isNew && (bricks >> n & 1) == 0) continue;
        hasRoom &=
            setBrick(entries.subspan(kTilesPerBrick * static_cast<std::size_t>(n)).first<kTilesPerBrick>(),
                     light.brick(n));
    }
    uploadEntries(pos, it->second);
    shown_[placeOf(pos)] = pos;
    return hasRoom;
}

void LightStore::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    release(found->second);
    chunks_.erase(found);
    // Keeps the entries of a chunk that took the place meanwhile.
    std::optional<world::ChunkPos>& shown = shown_[placeOf(pos)];
    if (shown != pos) return;
    shown.reset();
    uploadEntries(pos, filled(shared::kLightUnknown));
}

void LightStore::addTo(gpu::TextureSet& textures) const {
    textures.add(shared::kLightGridUnit, grid_.id()).add(shared::kLightPoolUnit, pool_.id());
}

}  // namespace terrane::render
