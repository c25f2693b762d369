// A world that is played: its chunks, the pipeline that loads, lights and meshes them, its store, its players
// and its clock. Players change blocks by edit(), build() and undoOrRedo(); the changes go to the pipeline,
// and so to the screen and the disk, and to the listeners of `events`. Uses no OpenGL. It is used on one
// thread, the world's.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/game/build_command.h"
#include "terrane/game/chat.h"
#include "terrane/game/edit_command.h"
#include "terrane/game/edit_history.h"
#include "terrane/game/events.h"
#include "terrane/game/permissions.h"
#include "terrane/game/player_items.h"
#include "terrane/game/player_state.h"
#include "terrane/game/session_parts.h"
#include "terrane/gen/level_generators.h"
#include "terrane/light/light_sources.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/changes/liquid_flow.h"
#include "terrane/world/pose.h"
#include "terrane/world/world.h"

namespace terrane::game {

class Session {
  public:
    explicit Session(SessionParts parts);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Checks a command and applies it. Light, meshes and the store follow with the pipeline's next update.
    EditResult edit(const EditCommand& command);
    // Does the same for many commands in their order and returns one result for each. The time is
    // proportional to the number of blocks.
    std::vector<EditResult> edit(std::span<const EditCommand> commands);

    // Fills a box or places a structure, all of it or nothing, as one step of the player's history.
    BuildOutcome build(const BuildCommand& command);

    // Undoes the player's last step, or redoes the step that was undone last. One call of edit() is one step
    // with its immediate consequences; using blocks (doors, containers) is not a step. The distance is not
    // checked, since these blocks were in reach before.
    UndoResult undoOrRedo(PlayerId player, HistoryWay way);

    // Acts with the items of a player, in any mode: moves a stack, crafts, uses an item, selects a slot.
    // Items and the blocks that hold them change together.
    EditResult act(PlayerId player, const ItemAction& action);
    // Adds items to those of a player; returns the number of items that did not fit.
    int give(PlayerId player, const world::ItemStack& stack);
    // Takes at most `count` items from a player; returns their number.
    int take(PlayerId player, std::string_view item, int count);
    // Sets the mode of a player; none: the world's.
    void setMode(PlayerId player, std::optional<Mode> mode);
    Mode modeOf(PlayerId player) const;
    const PlayerItems& itemsOf(PlayerId player) const;  // none of an unknown player
    bool knowsItems(PlayerId player) const { return items_.contains(player); }
    // Sets the items of a player, as a store or a server has them; tells nobody.
    void setItems(PlayerId player, PlayerItems items);
    // Returns what the player holds as a tool.
    world::Tool toolOf(PlayerId player) const;

    // Returns the chunks that undoOrRedo() needs loaded; empty if there is no such step.
    std::vector<world::ChunkPos> chunksOfNextStep(PlayerId player, HistoryWay way) const;

    // Sets exactly these blocks, as a server or a history gives them: nothing is checked and no behavior is
    // called. Blocks in chunks that are not loaded are left out.
    void setBlocks(std::span<const world::PlacedBlock> blocks);
    // Runs the rules of these blocks and their neighbors, as after a change: liquid runs dry or flows, plants
    // without ground and loose sand fall. For blocks that setBlocks() has set. A change by kNoPlayer.
    void runRules(std::span<const world::BlockPos> positions);

    // Sets the authority, which decides on players' commands from now on; with an empty one the session
    // itself decides again.
    void setAuthority(Authority authority) { authority_ = std::move(authority); }

    // Sets the pose of a player, by which its edits are checked. The first call begins its history.
    void setPlayer(PlayerId player, const world::Pose& pose) { players_[player].pose = pose; }
    // Returns the pose; none of an unknown player.
    std::optional<world::Pose> poseOf(PlayerId player) const;
    void removePlayer(PlayerId player) { players_.erase(player); }

    // Advances game time: the clock, and ticks of blocks near `center` (plants grow, liquids flow).
    void advance(double seconds, world::ChunkPos center);
    // Does the same for blocks of these chunks.
    void advance(double seconds, std::span<const world::ChunkPos> chunks);

    // Passes all changed chunks to the store, and what listeners of Saving add, as one transaction.
    void queueSaves();
    // Does so and waits until all changes are in the store.
    [[nodiscard]] base::Result<void> save();

    const world::BlockRegistry& blocks() const { return *blocks_; }
    const world::World& world() const { return world_; }
    const gen::Generator& generator() const { return generator_; }  // of level 0
    const gen::LevelGenerators& generators() const { return generators_; }
    store::ChunkStore& store() { return *store_; }
    stream::ChunkPipeline& pipeline() { return pipeline_; }
    const stream::ChunkPipeline& pipeline() const { return pipeline_; }
    // Builds the tiles that edits change, for a world that lacks them. A persistent store has them from the
    // beginning; other worlds need them only once land beyond the chunks is shown.
    void buildTiles();
    // Returns the pipeline of the land beyond the chunks.
    stream::TilePipeline& tiles() { return tiles_; }
    const stream::TilePipeline& tiles() const { return tiles_; }
    std::vector<stream::TaskTime> taskTimes() const;  // of the work on chunks, then on tiles
    // Returns the workers of both pipelines. With 0 threads, the caller runs the jobs.
    base::JobSystem& jobs() { return jobs_; }

    DayClock clock;
    Mode mode = Mode::Creative;  // of players without their own
    // Holds the changes that one command causes together until the result is released, so that a crash leaves
    // all or none of them. May be empty.
    std::function<std::shared_ptr<void>()> together;
    Permissions permissions;
    Events events;
    std::vector<ChatCommand> chatCommands;
    std::vector<std::string> packs;  // names of those that change blocks; number 1 is the first

  private:
    struct PlayerEntry {
        world::Pose pose;
        EditHistory history;
        double breaksSince = 0;  // seconds of the session; time before is spent on broken blocks
    };
    // The changes of a player's commands: steps that can be undone, and uses (doors, containers).
    struct PlayerChanges {
        world::BlockRecorder steps, uses;
    };
    std::vector<EditResult> applyAll(std::span<const EditCommand> commands);
    EditResult apply(const EditCommand& command, std::vector<world::BlockEdit>& edits,
                     PlayerChanges& changes);
    std::optional<BlockAction> actionOf(const EditCommand& command) const;
    bool isRefused(const BlockAction& action);
    bool isRefused(const BuildAction& action);
    bool canReach(PlayerId player, world::BlockPos pos) const;
    bool breaksForeign(PlayerId player, std::span<const world::BlockEdit> edits) const;
    void takeBackAll(std::span<const world::PlacedBlock> former, std::vector<world::BlockEdit>& edits,
                     std::size_t firstEdit);
    void flow(std::span<const world::ChunkPos> chunks);
    std::optional<EditResult> refusalOfBreaking(const EditCommand& command) const;
    void notifyEdits(Author author, std::span<const world::BlockEdit> edits);
    EditStep notifyStep(Author author, world::BlockRecorder& recorder);
    bool hasHistory() const { return !events.changed.isEmpty() || !events.changedAtAll.isEmpty(); }
    EditResult predictEdit(const EditCommand& command);
    bool isSurvival(const EditCommand& command) const;
    std::optional<EditResult> refusalOfSurvival(const EditCommand& command) const;
    void settle(const EditCommand& command, world::BlockId there);
    world::ItemStack dropOf(PlayerId player, world::BlockId block) const;
    EditResult move(PlayerId player, const MoveStack& wanted);
    EditResult craft(PlayerId player, const CraftItems& craft);
    EditResult useItem(PlayerId player);
    EditResult select(PlayerId player, const SelectSlot& select);
    void notifyItems(PlayerId player) { events.items.notify({player}); }

    // These refer to each other and are destroyed in reverse order.
    std::shared_ptr<const world::BlockRegistry> blocks_;
    world::BlockRegistry farBlocks_;
    light::LightTable lights_;
    gen::LevelGenerators generators_;
    const gen::Generator& generator_;
    std::unique_ptr<store::ChunkStore> store_;  // makes tiles of edited chunks until it ends
    world::World world_;
    base::JobSystem jobs_;
    stream::ChunkPipeline pipeline_;
    stream::TilePipeline tiles_;

    std::unordered_map<PlayerId, PlayerEntry> players_;
    world::FlowRecord flow_;  // who made liquid flow, by numberOf(); kept only for a history
    std::unordered_map<PlayerId, PlayerItems> items_;  // of all who played since the session began
    std::vector<PlayerId> paid_;        // whose items changed with blocks that were not told yet
    std::optional<PlayerItems> moved_;  // of the player who moves a stack, once the block has changed
    double seconds_ = 0;                // of game time
    Authority authority_;
    double untilTick_ = 0;  // seconds of game time that are not yet a whole tick
    std::uint64_t ticks_ = 0;
};

// Returns the type of a block with a collision box around a point, or less than `margin` blocks from it along
// each axis; null if there is none.
const world::BlockType* solidBlockAt(const Session& session, const glm::dvec3& point, double margin = 0);

// Returns whether a point is in water: below its surface, if that is in the same block.
bool isUnderWater(const Session& session, const glm::dvec3& point);
// Returns the number of water blocks above a point, its own included, at most 64; 0 if it is in air.
int waterAbove(const Session& session, const glm::dvec3& point);

}  // namespace terrane::game
