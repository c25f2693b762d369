#include "terrane/game/build_command.h"

#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "terrane/base/result.h"
#include "terrane/game/session.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/blocks/sign.h"

namespace terrane::game {
namespace {

using world::BlockBox;
using world::BlockPos;
using world::BlockValue;

// The far end of a box along one axis, clamped to the largest coordinate.
std::int32_t farEnd(std::int32_t low, int size) {
    constexpr std::int64_t kLast = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::min(std::int64_t{low} + size - 1, kLast));
}

bool isWhole(const BlockBox& box, const BuildChange& change) {
    const auto* place = std::get_if<PlaceStructure>(&change);
    return !place || box.blockCount() == place->structure->blockCount();
}

bool isLoaded(const world::World& world, const BlockBox& box) {
    for (std::int32_t y = box.low.y >> 4; y <= box.high.y >> 4; ++y)
        for (std::int32_t x = box.low.x >> 4; x <= box.high.x >> 4; ++x)
            if (!world.isMade(
                    {x * world::kChunkSize, y * world::kChunkSize, world.heights().clamp(box.low.z)}))
                return false;
    return true;
}

class Plan {
  public:
    Plan(const world::World& world, bool protectsFloor) : world_(world), protectsFloor_(protectsFloor) {}

    void add(BlockPos pos, BlockValue value) {
        const BlockValue now = world::blockValue(world_, pos);
        if (now == value) return;
        if (protectsFloor_ && pos.z == world_.heights().bottom && now.id != world::kAir) {
            ++plan_.skipped;
            return;
        }
        plan_.blocks.push_back({pos, std::move(value)});
    }
    PlannedBlocks take() { return std::move(plan_); }

  private:
    const world::World& world_;
    bool protectsFloor_;
    PlannedBlocks plan_;
};

// Chunk by chunk, and in a chunk by block index: the order that histories and light need.
template <class Function>
void forEachBlock(const BlockBox& box, Function function) {
    for (std::int32_t chunkY = box.low.y >> 4; chunkY <= box.high.y >> 4; ++chunkY)
        for (std::int32_t chunkX = box.low.x >> 4; chunkX <= box.high.x >> 4; ++chunkX) {
            // Offsets in the chunk: a counter of coordinates could not pass the last one of the world.
            const BlockPos corner = world::blockPos({chunkX, chunkY}, 0);
            const auto first = [](std::int32_t low, std::int32_t from) { return std::max(low, from) - from; };
            const auto last = [](std::int32_t high, std::int32_t from) {
                return static_cast<std::int32_t>(
                    std::min(std::int64_t{high} - from, std::int64_t{world::kChunkSize - 1}));
            };
            const std::int32_t x1 = last(box.high.x, corner.x), y1 = last(box.high.y, corner.y);
            for (std::int32_t z = box.low.z; z <= box.high.z; ++z)
                for (std::int32_t y = first(box.low.y, corner.y); y <= y1; ++y)
                    for (std::int32_t x = first(box.low.x, corner.x); x <= x1; ++x)
                        function(BlockPos{corner.x + x, corner.y + y, z});
        }
}

void planFill(Plan& plan, const world::World& world, const FillBox& fill) {
    forEachBlock(fill.box, [&](BlockPos pos) {
        if (!contains(fill.shape, fill.box, pos)) return;
        const world::BlockId there = world.block(pos);
        if (fill.replaced && there != *fill.replaced) return;
        if (fill.state == 0 && there == fill.id) return;  // its state stays
        plan.add(pos, {fill.id, fill.state, nullptr});
    });
}

void requireWhole(const world::Structure& structure) {
    base::require(structure.cells.size() == static_cast<std::size_t>(structure.blockCount()),
                  "PlaceStructure: each block of a structure needs a cell");
    const auto isNamed = [&](std::uint32_t entry) { return entry < structure.palette.size(); };
    base::require(std::ranges::all_of(structure.cells, isNamed),
                  "PlaceStructure: a cell is no index into the structure's palette");
}

// The data as a block of the type may hold it; null if it may not.
world::BlockEntityDataPtr fittingData(const world::BlockType& type, const world::BlockEntityDataPtr& data) {
    if (world::isSign(type)) return world::decodeSign(*data) ? data : nullptr;
    if (type.slots == 0) return data;
    auto fitted = world::fittedInventory(*data, type.slots);
    if (!fitted) return nullptr;
    if (*fitted == *data) return data;
    return std::make_shared<const world::BlockEntityData>(std::move(*fitted));
}

void planStructure(Plan& plan, const world::BlockRegistry& blocks, const PlaceStructure& place) {
    const world::Structure& structure = *place.structure;
    requireWhole(structure);
    const std::vector<BlockValue> values = world::paletteValues(structure, blocks);
    forEachBlock(boxOf(place), [&](BlockPos pos) {
        const std::uint32_t cell =
            structure.cellAt({pos.x - place.low.x, pos.y - place.low.y, pos.z - place.low.z});
        BlockValue value = values[structure.cells[cell]];
        const auto data = std::ranges::lower_bound(structure.data, cell, {}, &world::StructureData::cell);
        if (data != structure.data.end() && data->cell == cell) {
            value.data = fittingData(blocks.type(value.id), data->data);
        }
        plan.add(pos, std::move(value));
    });
}

BuildOutcome::Result check(const world::World& world, const BuildChange& change) {
    using Result = BuildOutcome::Result;
    const BlockBox box = boxOf(change);
    if (box.high.x < box.low.x || box.high.y < box.low.y || box.high.z < box.low.z) return Result::Empty;
    const world::Heights heights = world.heights();
    if (!heights.contains(box.low.z) || !heights.contains(box.high.z) || !isWhole(box, change))
        return Result::OutOfWorld;
    // First each side: the product of larger ones overflows.
    const auto isLong = [](std::int64_t low, std::int64_t high) {
        return high - low >= world::kMaxStructureBlocks;
    };
    if (isLong(box.low.x, box.high.x) || isLong(box.low.y, box.high.y)) return Result::TooLarge;
    if (box.blockCount() > world::kMaxStructureBlocks) return Result::TooLarge;
    return isLoaded(world, box) ? Result::Done : Result::NotLoaded;
}

}  // namespace

BlockBox boxOf(const BuildChange& change) {
    if (const auto* fill = std::get_if<FillBox>(&change)) return fill->box;
    const auto& place = std::get<PlaceStructure>(change);
    const glm::ivec3 size = place.structure ? place.structure->size : glm::ivec3(0);
    return {place.low,
            {farEnd(place.low.x, size.x), farEnd(place.low.y, size.y), farEnd(place.low.z, size.z)}};
}

double distanceTo(const BlockBox& box, const glm::dvec3& point) {
    const glm::dvec3 low(box.low.x, box.low.y, box.low.z);
    const glm::dvec3 high(box.high.x + 1.0, box.high.y + 1.0, box.high.z + 1.0);
    return glm::distance(point, glm::clamp(point, low, high));
}

PlannedBlocks plannedBlocks(const world::World& world, const world::BlockRegistry& blocks,
                            const BuildChange& change, bool protectsFloor) {
    Plan plan(world, protectsFloor);
    if (const auto* fill = std::get_if<FillBox>(&change)) {
        planFill(plan, world, *fill);
    } else {
        planStructure(plan, blocks, std::get<PlaceStructure>(change));
    }
    return plan.take();
}

BuildOutcome Session::build(const BuildCommand& command) {
    using Result = BuildOutcome::Result;
    const auto player = players_.find(command.player);
    const bool isPlayers = command.player != kNoPlayer && command.pack == kNoPack;
    if (isPlayers) {
        if (modeOf(command.player) != Mode::Creative) return {Result::NotAllowed};
        if (player == players_.end()) return {Result::OutOfReach};
        if (distanceTo(boxOf(command.change), player->second.pose.position) > kBuildReach)
            return {Result::OutOfReach};
    }
    if (const Result result = check(world_, command.change); result != Result::Done) return {result};
    if (authority_.build && isPlayers) {
        authority_.build(command);
        return {Result::Sent};
    }
    const PlannedBlocks plan = plannedBlocks(world_, *blocks_, command.change, isPlayers);
    if (!mayChangeAll(permissions, command.player, plan.blocks)) return {Result::NotAllowed};
    // Blocks of a structure keep their states; behaviors may change those of a fill.
    const bool isFill = std::holds_alternative<FillBox>(command.change);
    const BuildAction action{isFill ? BuildAct::Fill : BuildAct::Structure, command.player,
                             boxOf(command.change), plan.blocks.size()};
    if (isPlayers && isRefused(action)) return {Result::Refused};
    const bool isRecorded = command.player != kNoPlayer || (command.pack != kNoPack && hasHistory());
    std::vector<world::BlockEdit> edits;
    world::BlockRecorder recorder;
    world::BlockUpdate update(world_, *blocks_, edits, isRecorded ? &recorder : nullptr);
    update.restore(plan.blocks, isFill ? world::RestoreScope::All : world::RestoreScope::Border);
    update.run();
    if (breaksForeign(command.player, edits)) {
        takeBackAll(recorder.take(), edits, 0);
        return {Result::NotAllowed};
    }
    if (isRecorded) {
        EditStep step = notifyStep({command.player, command.pack}, recorder);
        if (isPlayers) player->second.history.add(std::move(step));
    }
    notifyEdits({command.player, command.pack}, edits);
    if (isPlayers) events.build.notify(BuildAction(action));
    return {Result::Done, plan.blocks.size(), plan.skipped};
}

}  // namespace terrane::game
