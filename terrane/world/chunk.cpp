#include "terrane/world/chunk.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::world {

Chunk::Chunk(Heights heights)
    : heights_(heights),
      lowestMade_(heights.firstSection()),
      blocks_(static_cast<std::size_t>(heights.sections())),
      blockState_(static_cast<std::size_t>(heights.sections())) {
    assert(isValid(heights) && "whoever makes a world checks its heights");
}

void Chunk::setBlock(BlockIndex i, BlockId id) {
    clearBlockEntityData(i);
    setBlockState(i, 0);
    blocks_[place(sectionOf(i))].set(indexInSection(i), id);
}

void Chunk::setBlockState(BlockIndex i, std::uint16_t value) {
    blockState_[place(sectionOf(i))].set(indexInSection(i), value);
}

const BlockEntityData* Chunk::blockEntityData(BlockIndex i) const {
    if (entityData_.empty()) return nullptr;
    const auto found = entityData_.find(i);
    return found == entityData_.end() ? nullptr : found->second.get();
}

BlockEntityDataPtr Chunk::sharedBlockEntityData(BlockIndex i) const {
    if (entityData_.empty()) return nullptr;
    const auto found = entityData_.find(i);
    return found == entityData_.end() ? nullptr : found->second;
}

void Chunk::setBlockEntityData(BlockIndex i, BlockEntityData data) {
    shareBlockEntityData(i, std::make_shared<const BlockEntityData>(std::move(data)));
}

void Chunk::shareBlockEntityData(BlockIndex i, BlockEntityDataPtr data) {
    base::require(data != nullptr,
                  "Chunk::shareBlockEntityData: null; clearBlockEntityData() takes data away");
    entityData_[i] = std::move(data);
}

void Chunk::clearBlockEntityData(BlockIndex i) {
    if (!entityData_.empty()) entityData_.erase(i);
}

std::size_t Chunk::blockEntityDataBytes() const {
    std::size_t bytes = 0;
    for (const auto& [index, data] : entityData_) bytes += data->size();
    return bytes;
}

std::vector<BlockIndex> Chunk::blocksWithBlockEntityData() const {
    std::vector<BlockIndex> blocks;
    blocks.reserve(entityData_.size());
    for (const auto& [i, data] : entityData_) blocks.push_back(i);
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

void Chunk::requireSection(int number) const {
    base::require(number >= heights_.firstSection() && number < heights_.endSection(),
                  "Chunk: the section is above or below the chunk");
}

void Chunk::setSection(int number, Section section) {
    requireSection(number);
    std::erase_if(entityData_, [&](const auto& entry) { return sectionOf(entry.first) == number; });
    blocks_[place(number)] = std::move(section);
    blockState_[place(number)] = Section();
}

void Chunk::setBlockStateSection(int number, Section section) {
    requireSection(number);
    blockState_[place(number)] = std::move(section);
}

void Chunk::unmakeBelow(int section) {
    for (; lowestMade_ < section; ++lowestMade_) setSection(lowestMade_, Section(kUnmade));
}

void Chunk::makeDeeper(const Chunk& deeper) {
    base::require(heights_ == deeper.heights_, "Chunk::makeDeeper: a chunk of other heights");
    const int end = lowestMade_;
    for (int number = deeper.lowestMade_; number < end; ++number) {
        blocks_[place(number)] = deeper.section(number);
        blockState_[place(number)] = deeper.blockStates(number);
    }
    for (const auto& [index, data] : deeper.entityData_)
        if (sectionOf(index) < end) entityData_[index] = data;
    lowestMade_ = std::min(end, deeper.lowestMade_);
}

bool operator==(const Chunk& a, const Chunk& b) {
    const auto isInB = [&](const auto& entry) {
        const BlockEntityData* data = b.blockEntityData(entry.first);
        return data && *data == *entry.second;
    };
    return a.heights_ == b.heights_ && a.lowestMade_ == b.lowestMade_ && a.blocks_ == b.blocks_ &&
           a.blockState_ == b.blockState_ && a.entityData_.size() == b.entityData_.size() &&
           std::ranges::all_of(a.entityData_, isInB);
}

std::size_t Chunk::memoryBytes() const {
    // A hash table has a pointer for each bucket, and a link and an entry for each element.
    constexpr std::size_t kEntryBytes =
        sizeof(void*) + sizeof(std::pair<const BlockIndex, BlockEntityDataPtr>);
    std::size_t bytes = sizeof(Chunk);
    for (const Section& section : blocks_) bytes += section.memoryBytes();
    for (const Section& section : blockState_) bytes += section.memoryBytes();
    if (!entityData_.empty()) bytes += entityData_.bucket_count() * sizeof(void*);
    for (const auto& [i, data] : entityData_) bytes += kEntryBytes + data->capacity();
    return bytes;
}

void addToDigest(base::Digest& digest, const Chunk& chunk) {
    std::array<Section::Value, kBlocksPerSection> values;
    for (int s = chunk.heights().firstSection(); s < chunk.heights().endSection(); ++s) {
        chunk.section(s).unpack(values);
        digest.update(std::as_bytes(std::span(values)));
    }
}

}  // namespace terrane::world
