#include "terrane/world/block_edit.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace terrane::world {

void BlockUpdate::change(BlockPos pos, const BlockChange& change) {
    if (const auto* block = std::get_if<SetBlock>(&change)) return setBlock(pos, block->id);
    if (!std::holds_alternative<RunTick>(change)) return setData(pos, change);
    calls_.push_back({.simple = &BlockBehavior::tick, .pos = pos, .id = world_.block(pos), .removed = {}});
}

void BlockUpdate::setBlock(BlockPos pos, BlockId id) {
    const BlockId before = world_.block(pos);
    if (before == id || !canStand(pos, id)) return;
    Chunk* chunk = world_.findWritable(pos);
    if (!chunk) return;
    if (behaviorWith(blocks_.type(before), &BlockBehavior::removed)) {
        const BlockEntityData* data = chunk->blockEntityData(blockIndex(pos));
        const std::uint16_t state = data ? std::uint16_t{0} : chunk->blockState(blockIndex(pos));
        calls_.push_back(
            {.pos = pos, .id = id, .removed = {before, state, data ? *data : BlockEntityData{}}});
    }
    write(*chunk, pos, id);
    if (behaviorWith(blocks_.type(id), &BlockBehavior::placed))
        calls_.push_back({.simple = &BlockBehavior::placed, .pos = pos, .id = id, .removed = {}});
    noteNeighbors(pos);
}

// The event of the block that is new there tells of its data as well.
void BlockUpdate::setData(BlockPos pos, const BlockChange& change) {
    Chunk* chunk = world_.findWritable(pos);
    if (!chunk) return;
    if (const auto* state = std::get_if<SetState>(&change))
        chunk->setBlockState(blockIndex(pos), state->value);
    if (const auto* data = std::get_if<SetEntityData>(&change))
        chunk->setBlockEntityData(blockIndex(pos), data->data);
    const auto isThere = [&](const BlockEdit& edit) { return edit.pos == pos; };
    if (std::any_of(edits_.begin() + static_cast<std::ptrdiff_t>(firstEdit_), edits_.end(), isThere)) return;
    const BlockId id = chunk->block(blockIndex(pos));
    edits_.push_back({pos, id, id});
}

void BlockUpdate::move(BlockPos from, BlockPos to) {
    assert(from != to && "a block moves to another place");
    const BlockId id = world_.block(from);
    if (id == kAir || !canStand(to, id) || !world_.findWritable(to)) return;
    Chunk* source = world_.findWritable(from);
    const std::uint16_t state = source->blockState(blockIndex(from));
    const BlockEntityData* data = source->blockEntityData(blockIndex(from));
    const BlockChange kept = data ? BlockChange(SetEntityData{*data}) : BlockChange(SetState{state});
    const bool hasData = data || state != 0;
    write(*source, from, kAir);
    write(*world_.findWritable(to), to, id);
    if (hasData) setData(to, kept);
    noteNeighbors(from);
    noteNeighbors(to);
}

bool BlockUpdate::canStand(BlockPos pos, BlockId id) const {
    return std::ranges::all_of(blocks_.type(id).behaviors, [&](const BehaviorPtr& behavior) {
        return !behavior->canStand || behavior->canStand(world_, blocks_, pos, id);
    });
}

void BlockUpdate::write(Chunk& chunk, BlockPos pos, BlockId id) {
    edits_.push_back({pos, chunk.block(blockIndex(pos)), id});
    chunk.setBlock(blockIndex(pos), id);
}

void BlockUpdate::noteNeighbors(BlockPos pos) {
    for (const Face face : {kFaceNegX, kFacePosX, kFaceNegY, kFacePosY, kFaceNegZ, kFacePosZ}) {
        const BlockPos next = beside(pos, face);
        const BlockId id = world_.block(next);
        if (!behaviorWith(blocks_.type(id), &BlockBehavior::neighborChanged)) continue;
        calls_.push_back({.pos = next, .id = id, .side = static_cast<Face>(face ^ 1), .removed = {}});
    }
}

void BlockUpdate::run() {
    for (std::size_t k = 0; k < calls_.size() && k < kMaxBehaviorCalls; ++k) {
        const Call call = std::move(calls_[k]);  // it may move while it runs: others come behind it
        runCall(call);
    }
    calls_.clear();
}

void BlockUpdate::runCall(const Call& call) {
    const bool isRemoval = call.removed.id != kAir;
    const BlockType& type = blocks_.type(isRemoval ? call.removed.id : call.id);
    for (const BehaviorPtr& behavior : type.behaviors) {
        // What a behavior before did may have replaced the block.
        if (!isRemoval && world_.block(call.pos) != call.id) return;
        if (isRemoval && behavior->removed) behavior->removed(*this, call.pos, call.removed);
        if (call.simple && (*behavior).*call.simple) ((*behavior).*call.simple)(*this, call.pos);
        if (call.side != kFaceCount && behavior->neighborChanged)
            behavior->neighborChanged(*this, call.pos, call.side);
    }
}

void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits) {
    BlockUpdate update(world, registry, edits);
    update.change(pos, change);
    update.run();
}

}  // namespace terrane::world
