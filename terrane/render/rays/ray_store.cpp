#include "terrane/render/rays/ray_store.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/mesh/draw_bucket.h"
#include "terrane/mesh_gpu/block_table.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/ray_blocks.h"

namespace terrane::render {
namespace {

using world::ChunkPos;
using Word = std::uint32_t;

// Level 10 is that of tiles 1,024 chunks wide: coarser than any that a horizon of 4,096 chunks needs.
constexpr int kLevels = 11;
constexpr Word kFirstWords = 1u << 18;  // of the buffer of blocks: 1 MiB
constexpr std::size_t kWordBytes = sizeof(Word);

// Windows reach half a side to each side of the camera; rings of tiles are up to 32 tiles wide.
int sideBitsOf(int viewDistance) {
    return viewDistance < 63 ? 7 : 8;
}

Word gridWords(const rays::Scene& scene) {
    return static_cast<Word>(scene.levels) << (2 * scene.sideBits);
}

// Whether blocks of a type may have a face that is blended, or one that is not.
rays::StopTable stopsOf(const world::BlockRegistry& blocks, bool isBlended) {
    const auto isSought = [&](std::uint16_t material) {
        const mesh::AlphaClass alpha = mesh::alphaClass(blocks.materials()[material].alpha);
        return (alpha == mesh::AlphaClass::Blended) == isBlended;
    };
    rays::StopTable stops = rays::stopTable(blocks, [&](const world::BlockType& type) {
        return type.shape != world::Shape::None &&
               (std::ranges::any_of(type.material, isSought) || std::ranges::any_of(type.growth, isSought));
    });
    // Ids without a type are of opaque cubes.
    if (isBlended) stops.resize(world::kUnmade + 1, 0);
    return stops;
}

std::size_t wordsOf(const world::Section& section) {
    if (section.isUniform()) return 0;
    return shared::rayIndexWords(static_cast<Word>(section.bits())) + section.palette().size();
}

// With the column's cells, which take a fifth at most beside blocks.
std::size_t bytesOf(const world::Chunk& chunk) {
    const world::Heights heights = chunk.heights();
    std::size_t words = shared::kRaySectionWords * static_cast<std::size_t>(heights.sections());
    for (int number = heights.firstSection(); number < heights.endSection(); ++number)
        words += wordsOf(chunk.section(number)) + wordsOf(chunk.blockStates(number));
    return words * kWordBytes * 6 / 5;
}

// Grows a buffer to hold `words`, with its content.
void grow(gpu::Buffer& buffer, std::size_t words, const char* label) {
    const std::size_t bytes = gpu::grownBytes(buffer.sizeBytes(), words * kWordBytes);
    if (bytes == 0) return;
    gpu::Buffer larger(bytes, GL_DYNAMIC_STORAGE_BIT, label);
    if (buffer.sizeBytes() > 0)
        glCopyNamedBufferSubData(buffer.id(), larger.id(), 0, 0, static_cast<GLsizeiptr>(buffer.sizeBytes()));
    buffer = std::move(larger);
}

}  // namespace

RayStore::RayStore(const world::BlockRegistry& blocks, world::Heights heights, int viewDistance)
    : heights_(heights) {
    const world::BlockRegistry farBlocks = blocks.forFarTiles();
    for (const bool isBlended : {false, true})
        stops_[isBlended] = {stopsOf(blocks, isBlended), stopsOf(farBlocks, isBlended)};
    mesh_gpu::BlockTable table(blocks), farTable(farBlocks);
    base::require(table.types.size() == farTable.types.size(), "RayStore: far blocks have the same ids");
    for (shared::MeshType& type : farTable.types) type.forms += static_cast<Word>(table.forms.size());
    table.types.insert(table.types.end(), farTable.types.begin(), farTable.types.end());
    table.forms.insert(table.forms.end(), farTable.forms.begin(), farTable.forms.end());
    base::require(table.forms.size() < 65536, "RayStore: a type has 16 bits for where its forms begin");
    types_ = gpu::Buffer(std::as_bytes(std::span(table.types)), 0, "block types of rays");
    forms_ = gpu::Buffer(std::as_bytes(std::span(table.forms)), 0, "block forms of rays");
    setViewDistance(viewDistance);
}

void RayStore::setViewDistance(int viewDistance) {
    const int sideBits = sideBitsOf(viewDistance);
    if (isUsed() && scenes_[0].sideBits == sideBits) return;
    scenes_.assign(2, rays::makeScene(heights_, kLevels, sideBits));
    sceneWords_ = {};
    const Word grid = gridWords(scenes_[0]);
    blocks_ = {};
    grow(blocks_, grid + kFirstWords, "blocks of rays");
    ranges_ = gpu::RangeAllocator(static_cast<Word>(blocks_.sizeBytes() / kWordBytes));
    const auto first = ranges_.allocate(grid);
    assert(first == 0u && "the grid is first");
    write(*first, std::vector<Word>(grid, 0));
    for (auto& [pos, tile] : tiles_) {
        tile.uploaded = nullptr;
        tile.sections.clear();
        tile.head = {};
        changed_.insert(pos);
    }
}

// --- Words of blocks ---

// Of the buffer of blocks.
std::size_t RayStore::mostBytes() {
    return std::min(gpu::maxBufferBytes(), shared::kMaxRayBlockWords * kWordBytes);
}

void RayStore::write(Word first, std::span<const Word> words) {
    blocks_.upload(first * kWordBytes, std::as_bytes(words));
}

RayStore::Range RayStore::allocate(Word count) {
    if (const auto first = ranges_.allocate(count)) return {*first, count};
    const std::size_t needed = blocks_.sizeBytes() + count * kWordBytes;
    if (needed > mostBytes()) return {};
    grow(blocks_, needed / kWordBytes, "blocks of rays");
    ranges_.grow(static_cast<Word>(blocks_.sizeBytes() / kWordBytes));
    return {ranges_.allocate(count).value(), count};
}

void RayStore::releaseRange(Range& range) {
    if (range.count > 0) ranges_.free(range.first, range.count);
    range = {};
}

// Uploads a section and returns its word.
Word RayStore::sectionWord(Range& range, const world::Section& section) {
    releaseRange(range);
    if (section.isUniform()) return section.uniformValue();
    words_.clear();
    for (const std::uint64_t word : section.words()) {
        words_.push_back(static_cast<Word>(word));
        words_.push_back(static_cast<Word>(word >> 32));
    }
    for (const world::Section::Value value : section.palette()) words_.push_back(value);
    range = allocate(static_cast<Word>(words_.size()));
    if (range.count == 0) return world::kUnmade;  // set() leaves room, but not for every order of changes
    write(range.first, words_);
    const auto form = static_cast<Word>(std::countr_zero(static_cast<unsigned>(section.bits())) + 1);
    return form << shared::kRayFormShift | range.first;
}

// --- Tiles ---

bool RayStore::set(ChunkPos pos, world::ChunkPtr chunk) {
    Tile& tile = tiles_[pos];
    const std::size_t bytes = bytesOf(*chunk);
    if (estimatedBytes_ - tile.estimatedBytes + bytes > std::min(maxBytes_, mostBytes() / 8 * 7)) {
        remove(pos);
        return false;
    }
    estimatedBytes_ += bytes - tile.estimatedBytes;
    tile.estimatedBytes = bytes;
    tile.chunk = std::move(chunk);
    changed_.insert(pos);
    return true;
}

void RayStore::remove(ChunkPos pos) {
    const auto found = tiles_.find(pos);
    if (found == tiles_.end()) return;
    estimatedBytes_ -= std::exchange(found->second.estimatedBytes, 0);
    found->second.chunk = nullptr;
    found->second.isShown = true;
    changed_.insert(pos);
}

void RayStore::setShown(ChunkPos pos, bool isShown) {
    Tile& tile = tiles_[pos];
    if (std::exchange(tile.isShown, isShown) != isShown || !tile.chunk) changed_.insert(pos);
}

void RayStore::unplace(ChunkPos pos, Tile& tile) {
    for (rays::Scene& scene : scenes_) rays::removeTile(scene, pos);
    for (Range& range : tile.sections) releaseRange(range);
    releaseRange(tile.head);
    constexpr Word kNone = 0;
    write(tile.entry, std::span(&kNone, 1));
    tile.uploaded = nullptr;
}

void RayStore::place(ChunkPos pos, Tile& tile) {
    const world::Chunk& chunk = *tile.chunk;
    for (std::size_t blended = 0; blended < 2; ++blended)
        rays::setTile(scenes_[blended], pos, rays::buildColumn(chunk, stops_[blended][pos.level > 0]));
    std::vector<Word> head;
    tile.sections.assign(shared::kRaySectionWords * static_cast<std::size_t>(heights_.sections()), {});
    auto range = tile.sections.begin();
    for (int number = heights_.firstSection(); number < heights_.endSection(); ++number) {
        head.push_back(sectionWord(*range++, chunk.section(number)));
        head.push_back(sectionWord(*range++, chunk.blockStates(number)));
    }
    tile.head = allocate(static_cast<Word>(head.size()));
    if (tile.head.count == 0) return unplace(pos, tile);
    write(tile.head.first, head);
    tile.entry =
        shared::rayBlockEntry(shared::rayEntryAt(rays::raysThrough(scenes_[0]), pos.level, pos.x, pos.y));
    write(tile.entry, std::span(&tile.head.first, 1));
    tile.uploaded = tile.chunk;
}

// Sections that are the same before and after keep their words.
void RayStore::replace(ChunkPos pos, Tile& tile) {
    const world::Chunk &before = *tile.uploaded, &now = *tile.chunk;
    rays::SectionCells cells;
    for (int number = heights_.firstSection(); number < heights_.endSection(); ++number) {
        const auto at = shared::kRaySectionWords * static_cast<std::size_t>(number - heights_.firstSection());
        const Word word = tile.head.first + static_cast<Word>(at);
        if (!before.section(number).isSame(now.section(number))) {
            for (std::size_t blended = 0; blended < 2; ++blended) {
                rays::buildCells(cells, now.section(number), stops_[blended][pos.level > 0]);
                rays::setSection(scenes_[blended], pos, number, cells);
            }
            const Word changed = sectionWord(tile.sections[at], now.section(number));
            write(word, std::span(&changed, 1));
        }
        if (!before.blockStates(number).isSame(now.blockStates(number))) {
            const Word changed = sectionWord(tile.sections[at + 1], now.blockStates(number));
            write(word + 1, std::span(&changed, 1));
        }
    }
    tile.uploaded = tile.chunk;
}

void RayStore::uploadScenes() {
    for (std::size_t k = 0; k < scenes_.size(); ++k) {
        rays::Scene& scene = scenes_[k];
        grow(sceneWords_[k], scene.words.size(), "cells of rays");
        rays::takeWritten(scene, [&](std::size_t first, std::size_t count) {
            sceneWords_[k].upload(first * kWordBytes,
                                  std::as_bytes(std::span(scene.words).subspan(first, count)));
        });
    }
}

void RayStore::update(ChunkPos camera) {
    TERRANE_ZONE("update rays");
    const bool isFirst = sceneWords_[0].sizeBytes() == 0;
    const bool hasMoved = camera != center_ || isFirst;
    if (!hasMoved && changed_.empty()) return;
    // Tiles that leave or enter the windows change, too.
    if (hasMoved) {
        center_ = camera;
        for (rays::Scene& scene : scenes_) rays::moveScene(scene, camera);
        for (const auto& [pos, tile] : tiles_)
            if (tile.uploaded ? !rays::hasTile(scenes_[0], pos)
                              : tile.chunk && tile.isShown && rays::isInWindow(scenes_[0], pos))
                changed_.insert(pos);
    }
    // First what goes away: each place is covered by one tile.
    for (const ChunkPos pos : changed_) {
        Tile& tile = tiles_[pos];
        const bool stays = tile.chunk && tile.isShown && rays::hasTile(scenes_[0], pos);
        if (tile.uploaded && !stays) unplace(pos, tile);
    }
    for (const ChunkPos pos : changed_) {
        Tile& tile = tiles_[pos];
        if (tile.chunk && tile.isShown) {
            if (tile.uploaded)
                replace(pos, tile);
            else if (rays::isFree(scenes_[0], pos))
                place(pos, tile);
        } else if (!tile.chunk && tile.isShown) {
            tiles_.erase(pos);
        }
    }
    changed_.clear();
    uploadScenes();
}

void RayStore::bind(bool isBlended) const {
    sceneWords_[isBlended].bindStorage(shared::kRayWordsBinding);
    blocks_.bindStorage(shared::kRayBlocksBinding);
    types_.bindStorage(shared::kRayTypesBinding);
    forms_.bindStorage(shared::kRayFormsBinding);
}

std::size_t RayStore::gpuBytes() const {
    return sceneWords_[0].sizeBytes() + sceneWords_[1].sizeBytes() + blocks_.sizeBytes() +
           types_.sizeBytes() + forms_.sizeBytes();
}

std::size_t RayStore::usedBytes() const {
    if (!isUsed()) return 0;
    return (scenes_[0].wordsInUse + scenes_[1].wordsInUse + ranges_.capacity() - ranges_.freeTotal()) *
           kWordBytes;
}

}  // namespace terrane::render
