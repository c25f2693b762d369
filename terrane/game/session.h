// A world that is played: its chunks, the pipeline that loads, lights and meshes them, its store, its players
// and its clock. Commands come in through edit(), build() and takeBack(), the only ways to change a block;
// events go out to the pipeline and so to screens and disk. Free of OpenGL. Used on one thread, the world's.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/game/build_command.h"
#include "terrane/game/day_clock.h"
#include "terrane/game/edit_command.h"
#include "terrane/game/edit_history.h"
#include "terrane/game/permissions.h"
#include "terrane/game/session_parts.h"
#include "terrane/gen/level_generators.h"
#include "terrane/light/light_table.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/world/block_registry.h"
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
    // The same for many, in their order: one result each. Time grows with the number of blocks.
    std::vector<EditResult> edit(std::span<const EditCommand> commands);

    // Fills a box or places a structure, all of it or nothing; the player's next step to undo.
    BuildOutcome build(const BuildCommand& command);

    // Undoes the player's last edits, or does again what was undone last. One call of edit() is one step,
    // with all that followed from it at once; what was used (doors, containers) is none. From anywhere: these
    // blocks were in reach once.
    TakenBack takeBack(PlayerId player, HistoryWay way);

    // The chunks that takeBack() needs loaded; none where there is no such step.
    std::vector<world::ChunkPos> chunksToTakeBack(PlayerId player, HistoryWay way) const;

    // Called with the events of each change, and who made it, after it was made: for sounds. It changes no
    // block.
    using EditListener = std::function<void(PlayerId, std::span<const world::BlockEdit>)>;
    void setEditListener(EditListener listener) { editListener_ = std::move(listener); }

    // Called with what a player's edit, building or undoing changed, each block once: for a history of who
    // changed what; with `tellsAll` also with what nobody takes back: what grew and flowed, as kNoPlayer's,
    // and liquid that is to be looked at.
    using ChangeListener = std::function<void(PlayerId, std::span<const ChangedBlock>)>;
    void setChangeListener(ChangeListener listener, bool tellsAll = false) {
        changeListener_ = std::move(listener);
        tellsAll_ = tellsAll;
    }

    // Exactly these blocks, as a server tells them or a history brings them back: nothing is checked, and no
    // block falls or goes for it. Those in chunks that are not loaded are left out.
    void setBlocks(std::span<const world::PlacedBlock> blocks);

    // From now on commands of players are the authority's to decide on. An empty one: the session's own
    // again.
    void setAuthority(Authority authority) { authority_ = std::move(authority); }

    // Where a player stands: its edits are checked against that. Its history begins with the first call.
    void setPlayer(PlayerId player, const world::Pose& pose) { players_[player].pose = pose; }
    void removePlayer(PlayerId player) { players_.erase(player); }

    // Game time passes: the day, and blocks near `center` get their ticks (plants grow, liquids flow).
    void advance(double seconds, world::ChunkPos center);
    // The same for blocks of these chunks.
    void advance(double seconds, std::span<const world::ChunkPos> chunks);

    // Waits until all that changed is in the store.
    [[nodiscard]] base::Result<void> save();

    const world::BlockRegistry& blocks() const { return *blocks_; }
    const world::World& world() const { return world_; }
    const gen::Generator& generator() const { return generator_; }  // of level 0
    const gen::LevelGenerators& generators() const { return generators_; }
    store::ChunkStore& store() { return *store_; }
    stream::ChunkPipeline& pipeline() { return pipeline_; }
    const stream::ChunkPipeline& pipeline() const { return pipeline_; }
    // The tiles that edits change, of a world that lacks them. A store that lasts has them from the
    // beginning; others need them only once land beyond the chunks is shown.
    void buildTiles();
    // Land beyond the chunks.
    stream::TilePipeline& tiles() { return tiles_; }
    const stream::TilePipeline& tiles() const { return tiles_; }
    std::vector<stream::TaskTime> taskTimes() const;  // of the work on chunks, then on tiles

    DayClock clock;
    Permissions permissions;

  private:
    struct PlayerEntry {
        world::Pose pose;
        EditHistory history;
    };
    // What a player's commands changed: steps that it can undo, and what it used (doors, containers).
    struct PlayerChanges {
        world::BlockRecorder steps, uses;
    };
    EditResult apply(const EditCommand& command, std::vector<world::BlockEdit>& edits,
                     PlayerChanges& changes);
    bool canReach(PlayerId player, world::BlockPos pos) const;
    std::optional<EditResult> refusalOfBreaking(const EditCommand& command) const;
    void tellEdits(PlayerId player, std::span<const world::BlockEdit> edits);
    EditStep tellStep(PlayerId player, world::BlockRecorder& recorder);
    void tellChanges(PlayerId player, std::span<const ChangedBlock> changes);
    EditResult editAhead(const EditCommand& command);

    // They refer to each other: destroyed in reverse order.
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
    EditListener editListener_;
    ChangeListener changeListener_;
    bool tellsAll_ = false;
    Authority authority_;
    double untilTick_ = 0;  // seconds of game time that made no tick yet
    std::uint64_t ticks_ = 0;
};

// Whether a point is in water: below its surface, where that is in the same block.
bool isUnderWater(const Session& session, const glm::dvec3& point);
// Blocks of water over a point, its own included, 64 at most; 0 where it is in air.
int waterAbove(const Session& session, const glm::dvec3& point);

}  // namespace terrane::game
