#include "terrane/world/changes/liquid_flow.h"

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <utility>

#include "terrane/world/blocks/block_behavior.h"

namespace terrane::world {
namespace {

constexpr std::array<Face, 4> kFlowSides{kFaceNegX, kFacePosX, kFaceNegY, kFacePosY};

void unsettle(BlockUpdate& update, BlockPos pos) {
    const std::uint16_t state = update.world().blockState(pos);
    if ((state & kUnsettled) != 0) return;
    update.change(pos, SetState{static_cast<std::uint16_t>(state | kUnsettled)});
}

// Ladders, blocks that players use and blocks with slots are not washed away.
bool isWashedAway(const BlockType& type) {
    if (type.id == kAir) return true;
    const bool holdsOn = type.climbable || type.slots > 0 || behaviorWith(type, &BlockBehavior::used);
    return type.shape != Shape::Liquid && type.collision.empty() && !holdsOn;
}

enum class Room : std::uint8_t { Full, Free, Liquid };  // Free: liquid flows into it

// Rules by block id.
struct FlowRules {
    explicit FlowRules(const BlockRegistry& blocks) : missing(blocks.missing()) {
        for (const BlockType& type : blocks.types()) {
            rooms.push_back(isWashedAway(type) ? Room::Free : isFlowing(type) ? Room::Liquid : Room::Full);
            if (rooms.back() == Room::Liquid) liquids.push_back(type.id);
            falls.push_back(hasBehavior(type, "falling"));
        }
    }
    bool isFalling(BlockId id) const { return id < falls.size() && falls[id]; }
    Room room(BlockId id) const { return rooms[id < rooms.size() ? id : missing]; }

    std::vector<Room> rooms;
    std::vector<bool> falls;
    std::vector<BlockId> liquids;
    BlockId missing;
};

struct FlowCell {
    BlockId id = kAir;
    std::uint16_t form = 0;  // of a liquid
    Room room = Room::Full;

    bool is(BlockId liquid) const { return id == liquid; }
    bool isSourceOf(BlockId liquid) const { return id == liquid && form == 0; }
    bool isGroundFor(BlockId liquid) const { return room != Room::Free && id != liquid; }
};

// Reads cells and keeps their chunks. Must be destroyed before a chunk is written: a chunk that is held would
// be copied.
class FlowCells {
  public:
    FlowCells(const World& world, const FlowRules& rules, const FlowOptions& options)
        : world_(world), rules_(rules), options_(options) {}

    const FlowRules& rules() const { return rules_; }
    bool mayReach(BlockPos from, BlockPos to) const {
        return !options_.mayReach || (*options_.mayReach)(from, to);
    }
    bool isInHeight(int z) const { return world_.heights().contains(z); }
    const Chunk* chunk(ChunkPos pos) {
        if (last_ && lastPos_ == pos) return last_;
        const auto [known, isNew] = chunks_.try_emplace(pos);
        if (isNew) known->second = world_.maybeChunkAt(pos);
        lastPos_ = pos;
        return last_ = known->second.get();
    }
    // Ground below the world, air above it.
    FlowCell at(BlockPos pos) {
        if (pos.z < world_.heights().bottom) return {};
        const Chunk* chunk = isInHeight(pos.z) ? this->chunk(chunkOf(pos)) : nullptr;
        if (!chunk) return {kAir, 0, Room::Free};
        const BlockIndex index = blockIndex(pos);
        const BlockId id = chunk->block(index);
        const Room room = rules_.room(id);
        if (room == Room::Liquid)
            return {id, static_cast<std::uint16_t>(chunk->blockState(index) & kLiquidForm), room};
        const bool holdsData = room == Room::Free && id != kAir && chunk->blockEntityData(index);
        return {id, 0, holdsData ? Room::Full : room};
    }
    // Whether all blocks within two blocks are there.
    bool isSurrounded(BlockPos pos) {
        const ChunkPos own = chunkOf(pos);
        const auto away = [](std::int32_t v) { return (v & 15) < 2 ? -1 : (v & 15) > 13 ? 1 : 0; };
        const int dx = away(pos.x), dy = away(pos.y);
        const int lowest = std::max(pos.z - 2, world_.heights().bottom) >> 4;
        const auto isLoaded = [&](int x, int y) {
            const Chunk* found = chunk(offsetBy(own, x, y));
            return found && found->isMade(lowest);
        };
        if (!isLoaded(0, 0)) return false;
        return (dx == 0 || isLoaded(dx, 0)) && (dy == 0 || isLoaded(0, dy)) &&
               (dx == 0 || dy == 0 || isLoaded(dx, dy));
    }
    static bool isMadeBelow(const Chunk& chunk, BlockPos pos) {
        return chunk.isMade(std::max(pos.z - 1, chunk.heights().bottom) >> 4);
    }

  private:
    const World& world_;
    const FlowRules& rules_;
    const FlowOptions& options_;
    std::unordered_map<ChunkPos, ChunkPtr, ChunkPosHash> chunks_;
    const Chunk* last_ = nullptr;
    ChunkPos lastPos_;
};

FlowCell nextCell(FlowCells& cells, BlockPos pos, BlockId liquid) {
    const FlowCell now = cells.at(pos);
    if (now.isSourceOf(liquid) || (!now.is(liquid) && now.room != Room::Free)) return now;
    int sources = 0, level = kMaxLiquidLevel + 1;
    for (const Face side : kFlowSides) {
        const BlockPos next = adjacent(pos, side);
        const FlowCell cell = cells.at(next);
        if (!cell.is(liquid) || !cells.mayReach(next, pos)) continue;
        sources += cell.form == 0;
        if (cell.form == 0 || cells.at(adjacent(next, kFaceNegZ)).isGroundFor(liquid))
            level = std::min(level, (cell.form & kLiquidLevel) + 1);
    }
    const FlowCell below = cells.at(adjacent(pos, kFaceNegZ));
    if (sources >= 2 && (below.isGroundFor(liquid) || below.isSourceOf(liquid)))
        return {liquid, 0, Room::Liquid};
    if (cells.at(adjacent(pos, kFacePosZ)).is(liquid)) return {liquid, kLiquidFalling, Room::Liquid};
    if (level <= kMaxLiquidLevel) return {liquid, static_cast<std::uint16_t>(level), Room::Liquid};
    return now.is(liquid) ? FlowCell{kAir, 0, Room::Free} : now;
}

// May be true for a section without such a cell, if its palette still has such a state.
bool mayBeUnsettled(const Section& states) {
    const auto isSettled = [](std::uint16_t state) { return (state & kUnsettled) == 0; };
    return !states.surelyAll(isSettled);
}

struct Unsettled {
    std::vector<BlockPos> cells;
    std::vector<BlockPos> falling;  // blocks that fall on: what is below is made now
    std::vector<BlockPos> former;   // one block of each section whose palette has such a state without a cell
};

void addUnsettled(FlowCells& cells, ChunkPos pos, int section, Unsettled& out) {
    const Chunk& chunk = *cells.chunk(pos);
    std::array<Section::Value, kBlocksPerSection> states;
    chunk.blockStates(section).unpack(states);
    bool isFormer = true;
    for (int i = 0; i < kBlocksPerSection; ++i) {
        if ((states[static_cast<std::size_t>(i)] & kUnsettled) == 0) continue;
        isFormer = false;
        if (out.cells.size() + out.falling.size() >= kMaxFlowingCells) return;
        const BlockPos at = blockPos(pos, section * kBlocksPerSection + i);
        const FlowCell cell = cells.at(at);
        if (cell.room == Room::Liquid && cells.isSurrounded(at)) out.cells.push_back(at);
        if (cells.rules().isFalling(cell.id) && cells.isMadeBelow(chunk, at)) out.falling.push_back(at);
    }
    if (isFormer && !chunk.blockStates(section).isDense())
        out.former.push_back({pos.x * kChunkSize, pos.y * kChunkSize, section * kSectionSize});
}

Unsettled findUnsettled(FlowCells& cells, std::span<const ChunkPos> chunks) {
    Unsettled found;
    for (const ChunkPos pos : chunks) {
        const Chunk* chunk = cells.chunk(pos);
        if (!chunk) continue;
        for (int section = chunk->heights().firstSection(); section < chunk->heights().endSection();
             ++section)
            if (mayBeUnsettled(chunk->blockStates(section))) addUnsettled(cells, pos, section, found);
    }
    return found;
}

struct CellChange {
    BlockPos pos;
    BlockId before = kAir;
    FlowCell after;
    BlockPos by;  // the unsettled cell for which it was computed
};

struct NextValues {
    std::vector<CellChange> changes;
    std::vector<BlockPos> settled;
};

NextValues nextValues(FlowCells& cells, const std::vector<BlockPos>& unsettled) {
    NextValues next;
    for (const BlockId liquid : cells.rules().liquids) {
        BlockSet seen;
        const auto look = [&](BlockPos pos, BlockPos by) {
            if (!cells.isInHeight(pos.z) || !seen.insert(pos)) return;
            const FlowCell before = cells.at(pos), after = nextCell(cells, pos, liquid);
            if (before.id != after.id || before.form != after.form)
                next.changes.push_back({pos, before.id, after, by});
        };
        for (const BlockPos pos : unsettled) {
            if (!cells.at(pos).is(liquid)) continue;
            next.settled.push_back(pos);
            look(pos, pos);
            for (const Face side : kFlowSides) look(adjacent(pos, side), pos);
            look(adjacent(pos, kFaceNegZ), pos);
        }
    }
    return next;
}

}  // namespace

BlockBehavior flows() {
    return {.name = "flows",
            .placed = unsettle,
            .neighborChanged = [](BlockUpdate& update, BlockPos pos, Face) { unsettle(update, pos); }};
}

bool isFlowing(const BlockType& type) {
    return type.shape == Shape::Liquid && hasBehavior(type, "flows");
}

double liquidHeight(const World& world, const BlockRegistry& blocks, BlockPos pos) {
    const BlockId id = world.block(pos);
    const BlockType& type = blocks.type(id);
    if (type.shape != Shape::Liquid) return 0;
    const int form = world.blockState(pos) & kLiquidForm;
    if ((form & kLiquidFalling) != 0 || world.block(adjacent(pos, kFacePosZ)) == id) return 1;
    const double surface = type.surface.heightUnits / double{shared::kSurfaceUnits};
    return surface * (kMaxLiquidLevel + 1 - form) / (kMaxLiquidLevel + 1);
}

namespace {

bool isUnsettled(const World& world, const BlockRegistry& blocks, BlockPos pos) {
    if ((world.blockState(pos) & kUnsettled) == 0) return false;
    const BlockType& type = blocks.type(world.block(pos));
    return isFlowing(type) || hasBehavior(type, "falling");
}

}  // namespace

void FlowRecord::note(const World& world, const BlockRegistry& blocks, std::span<const BlockEdit> edits,
                      FlowCause cause) {
    for (const BlockEdit& edit : edits) {
        if (!isUnsettled(world, blocks, edit.pos)) continue;
        if (cause == 0) {
            causes.erase(edit.pos);
            continue;
        }
        if (causes.size() >= kMaxCauses) forgetOthers(world, blocks);
        causes[edit.pos] = cause;
    }
}

// Cells that were replaced or unloaded while they flowed leave their cause behind.
void FlowRecord::forgetOthers(const World& world, const BlockRegistry& blocks) {
    std::erase_if(causes, [&](const auto& entry) { return !isUnsettled(world, blocks, entry.first); });
    if (causes.size() > kMaxCauses / 2) causes.clear();  // so that this is rare
}

// Writes call behaviors, which unsettle the neighbors of changed blocks. If a behavior has put another block
// into a cell by then, that stays.
std::size_t flowLiquids(World& world, const BlockRegistry& blocks, std::span<const ChunkPos> chunks,
                        std::vector<BlockEdit>& edits, const FlowOptions& options) {
    const FlowRules rules(blocks);
    Unsettled unsettled;
    NextValues next;
    {
        FlowCells cells(world, rules, options);
        unsettled = findUnsettled(cells, chunks);
        next = nextValues(cells, unsettled.cells);
    }
    FlowRecord* const record = options.record;
    // Causes of the cells of this tick: those of cells that its changes unsettle are for the next one.
    std::unordered_map<BlockPos, FlowCause, BlockPosHash> causes;
    const auto takeCauses = [&](std::span<const BlockPos> positions) {
        for (const BlockPos pos : positions) {
            if (!record || record->causes.empty()) break;
            if (auto known = record->causes.extract(pos)) causes.insert(std::move(known));
        }
    };
    takeCauses(next.settled);
    takeCauses(unsettled.falling);
    const auto causeOf = [&](BlockPos pos) {
        const auto found = causes.find(pos);
        return found == causes.end() ? FlowCause{0} : found->second;
    };
    const auto apply = [&](BlockPos pos, const BlockChange& change, FlowCause cause) {
        const std::size_t before = edits.size();
        applyChange(world, blocks, pos, change, edits, record ? &record->changes[cause] : nullptr,
                    options.mayReach);
        if (record) record->note(world, blocks, std::span(edits).subspan(before), cause);
    };
    for (const BlockPos pos : unsettled.former) BlockUpdate(world, blocks, edits).compactState(pos);
    for (const BlockPos pos : next.settled) {
        const std::uint16_t state = world.blockState(pos) & kLiquidForm;
        apply(pos, SetState{state}, causeOf(pos));
    }
    for (const CellChange& change : next.changes) {
        if (world.block(change.pos) != change.before) continue;
        const auto state = static_cast<std::uint16_t>(change.after.form | kUnsettled);
        const bool isDry = change.after.id == kAir;
        apply(change.pos, SetBlock{change.after.id, isDry ? std::uint16_t{0} : state}, causeOf(change.by));
    }
    for (const BlockPos pos : unsettled.falling) apply(pos, RunTick{}, causeOf(pos));
    return unsettled.cells.size() + unsettled.falling.size();
}

}  // namespace terrane::world
