#include "terrane/world/changes/block_edit.h"

#include <algorithm>
#include <utility>

namespace terrane::world {
namespace {

constexpr Face kAllFaces[] = {kFaceNegX, kFacePosX, kFaceNegY, kFacePosY, kFaceNegZ, kFacePosZ};

}  // namespace

void BlockUpdate::change(BlockPos pos, const BlockChange& change) {
    if (const auto* block = std::get_if<SetBlock>(&change)) return setBlock(pos, *block);
    const bool isTick = std::holds_alternative<RunTick>(change);
    if (!isTick && !std::holds_alternative<UseBlock>(change)) return setData(pos, change);
    calls_.push_back({.simple = isTick ? &BlockBehavior::tick : &BlockBehavior::used,
                      .pos = pos,
                      .id = world_.block(pos),
                      .removed = {}});
}

void BlockUpdate::setBlock(BlockPos pos, const SetBlock& block) {
    const BlockId before = world_.block(pos), id = block.id;
    const bool isSame = before == id && (block.state == 0 || world_.blockState(pos) == block.state);
    if (isSame || !canStand(pos, id)) return;
    Chunk* chunk = world_.findWritable(pos);
    if (!chunk) return;
    if (behaviorWith(blocks_.type(before), &BlockBehavior::removed)) {
        const BlockEntityData* data = chunk->blockEntityData(blockIndex(pos));
        const std::uint16_t state = chunk->blockState(blockIndex(pos));
        calls_.push_back(
            {.pos = pos, .id = id, .removed = {before, state, data ? *data : BlockEntityData{}}});
    }
    write(*chunk, pos, id);
    if (block.state != 0) chunk->setBlockState(blockIndex(pos), block.state);
    if (behaviorWith(blocks_.type(id), &BlockBehavior::placed))
        calls_.push_back({.simple = &BlockBehavior::placed, .pos = pos, .id = id, .removed = {}});
    noteNeighbors(pos);
}

void BlockUpdate::restore(std::span<const PlacedBlock> blocks, RestoreScope scope) {
    BlockSet restored;
    for (const PlacedBlock& block : blocks) {
        if (!world_.heights().contains(block.pos.z)) continue;
        setValue(block.pos, block.value);
        restored.insert(block.pos);
    }
    if (scope == RestoreScope::None) return;
    for (const PlacedBlock& block : blocks) {
        bool isTold = false;
        for (const Face face : kAllFaces) {
            const BlockPos next = adjacent(block.pos, face);
            if (restored.contains(next)) continue;
            noteChangedSide(block.pos, face);
            noteChangedSide(next, static_cast<Face>(face ^ 1));
            isTold = isTold || face == kFaceNegZ;
        }
        // Most behaviors look at the block below.
        if (scope == RestoreScope::All && !isTold) noteChangedSide(block.pos, kFaceNegZ);
    }
    maxCalls_ = calls_.size() + kMaxBehaviorCalls;
}

void BlockUpdate::compactState(BlockPos pos) {
    if (Chunk* chunk = world_.findWritable(pos)) chunk->compactBlockState(sectionOf(blockIndex(pos)));
}

void BlockUpdate::setValue(BlockPos pos, const BlockValue& value) {
    Chunk* chunk = world_.findWritable(pos);
    if (!chunk || blockValue(world_, pos) == value) return;
    write(*chunk, pos, value.id);
    if (value.state != 0) chunk->setBlockState(blockIndex(pos), value.state);
    if (value.data) chunk->shareBlockEntityData(blockIndex(pos), value.data);
}

// The event of a block that is new there covers its data as well.
void BlockUpdate::setData(BlockPos pos, const BlockChange& change) {
    Chunk* chunk = world_.findWritable(pos);
    if (!chunk) return;
    record(pos);
    if (const auto* state = std::get_if<SetState>(&change))
        chunk->setBlockState(blockIndex(pos), state->value);
    if (const auto* data = std::get_if<SetEntityData>(&change))
        chunk->setBlockEntityData(blockIndex(pos), data->data);
    if (hasEdit(pos)) return;
    const BlockId id = chunk->block(blockIndex(pos));
    edits_.push_back({pos, id, id});
}

// Few edits are searched linearly, many are kept as a set, since a fill calls this for each of its blocks.
bool BlockUpdate::hasEdit(BlockPos pos) {
    constexpr std::size_t kFew = 64;
    if (edits_.size() - firstEdit_ <= kFew) {
        const auto isThere = [&](const BlockEdit& edit) { return edit.pos == pos; };
        return std::any_of(edits_.begin() + static_cast<std::ptrdiff_t>(firstEdit_), edits_.end(), isThere);
    }
    for (; firstEdit_ + inSet_ < edits_.size(); ++inSet_) edited_.insert(edits_[firstEdit_ + inSet_].pos);
    return edited_.contains(pos);
}

void BlockUpdate::move(BlockPos from, BlockPos to) {
    if (from == to) return;
    const BlockId id = world_.block(from);
    if (id == kAir || !canStand(to, id) || !world_.findWritable(to)) return;
    Chunk* source = world_.findWritable(from);
    const std::uint16_t state = source->blockState(blockIndex(from));
    BlockEntityDataPtr data = source->sharedBlockEntityData(blockIndex(from));
    write(*source, from, kAir);
    Chunk& target = *world_.findWritable(to);
    write(target, to, id);
    if (state != 0) target.setBlockState(blockIndex(to), state);
    if (data) target.shareBlockEntityData(blockIndex(to), std::move(data));
    noteNeighbors(from);
    noteNeighbors(to);
}

bool BlockUpdate::canStand(BlockPos pos, BlockId id) const {
    return std::ranges::all_of(blocks_.type(id).behaviors, [&](const BehaviorPtr& behavior) {
        return !behavior->canStand || behavior->canStand(world_, blocks_, pos, id);
    });
}

void BlockUpdate::write(Chunk& chunk, BlockPos pos, BlockId id) {
    record(pos);
    edits_.push_back({pos, chunk.block(blockIndex(pos)), id});
    chunk.setBlock(blockIndex(pos), id);
}

void BlockUpdate::record(BlockPos pos) {
    if (recorder_) recorder_->note(pos, blockValue(world_, pos));
}

void BlockUpdate::noteNeighbors(BlockPos pos) {
    for (const Face face : kAllFaces) {
        const BlockPos next = adjacent(pos, face);
        if (!mayReach_ || (*mayReach_)(pos, next)) noteChangedSide(next, static_cast<Face>(face ^ 1));
    }
}

void BlockUpdate::noteChangedSide(BlockPos pos, Face side) {
    const BlockId id = world_.block(pos);
    if (!behaviorWith(blocks_.type(id), &BlockBehavior::neighborChanged)) return;
    calls_.push_back({.pos = pos, .id = id, .side = side, .removed = {}});
}

void BlockUpdate::run() {
    for (std::size_t k = 0; k < calls_.size() && k < maxCalls_; ++k) {
        const Call call = std::move(calls_[k]);  // new calls may reallocate the list while it runs
        runCall(call);
    }
    calls_.clear();
}

void BlockUpdate::runCall(const Call& call) {
    const bool isRemoval = call.removed.id != kAir;
    const BlockType& type = blocks_.type(isRemoval ? call.removed.id : call.id);
    for (const BehaviorPtr& behavior : type.behaviors) {
        // An earlier behavior may have replaced the block.
        if (!isRemoval && world_.block(call.pos) != call.id) return;
        if (isRemoval && behavior->removed) behavior->removed(*this, call.pos, call.removed);
        if (call.simple && (*behavior).*call.simple) ((*behavior).*call.simple)(*this, call.pos);
        if (call.side != kFaceCount && behavior->neighborChanged)
            behavior->neighborChanged(*this, call.pos, call.side);
    }
}

void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits, BlockRecorder* recorder, const MayReach* mayReach) {
    BlockUpdate update(world, registry, edits, recorder, mayReach);
    update.change(pos, change);
    update.run();
}

void restoreBlocks(World& world, const BlockRegistry& registry, std::span<const PlacedBlock> blocks,
                   std::vector<BlockEdit>& edits, BlockRecorder* recorder) {
    BlockUpdate update(world, registry, edits, recorder);
    update.restore(blocks);
    update.run();
}

}  // namespace terrane::world
