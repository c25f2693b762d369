// A world that is read and edited by areas: its block types, generators and store, and the threads that work
// on it. Python's World holds one; no OpenGL, no clock, no players.
//
// Any number of threads may read and write areas at a time. Two writes to one chunk come one after the other.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/gen/generators/biomes.h"
#include "terrane/gen/level_generators.h"
#include "terrane/light/light_sources.h"
#include "terrane/map/surface_source.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::volume {

struct WorldParts {
    std::shared_ptr<const world::BlockRegistry> blocks;  // not moved: others refer to it
    gen::LevelGenerators generators;                     // has level 0
    std::unique_ptr<store::ChunkStore> store;
    unsigned threads = 1;  // that work at a time, the calling one among them; 1 or more
};

// The reading and writing functions call it from time to time on the calling thread; if it returns false,
// they stop with the error kStopped.
using ShouldContinue = std::function<bool()>;
inline constexpr const char* kStopped = "stopped by the caller";

class OpenedWorld {
  public:
    // Builds the tiles of a world that lacks them (stream/edited_tiles.h).
    [[nodiscard]] static base::Result<std::unique_ptr<OpenedWorld>> create(WorldParts parts);
    OpenedWorld(const OpenedWorld&) = delete;
    OpenedWorld& operator=(const OpenedWorld&) = delete;

    const world::BlockRegistry& blocks() const { return *blocks_; }
    const light::LightTable& lights() const { return lights_; }
    // Returns the generator of a level, 0…15.
    [[nodiscard]] base::Result<const gen::Generator*> generator(int level) const {
        return generators_.at(level);
    }
    store::ChunkStore& store() { return *store_; }
    world::Heights heights() const { return generators_.heights(); }
    base::JobSystem& jobs() { return jobs_; }
    map::SurfaceSource& surfaces() { return surfaces_; }
    const gen::Biomes* biomes();                    // null if the generator has none
    std::mutex& editMutex() { return editMutex_; }  // held while chunks are read, changed and saved

    // Notes edited chunks that were saved to the store: their tiles and the surfaces of the land change.
    void markEdited(std::span<const world::ChunkPos> chunks);
    // Called with the chunks of each markEdited(), on its thread; empty: none. Returns when no call of the
    // former listener is running.
    using EditListener = std::function<void(std::span<const world::ChunkPos>)>;
    void setEditListener(EditListener listener);
    // Waits until tiles of levels above 0 show all edits so far.
    [[nodiscard]] base::Result<void> waitForTiles();
    // Returns the chunks among these, of any level, that are edited. The first call reads all rows of a saved
    // world.
    [[nodiscard]] base::Result<std::vector<map::EditedChunk>> editedAmong(
        std::span<const world::ChunkPos> chunks);

  private:
    explicit OpenedWorld(WorldParts parts);

    // These refer to each other and are destroyed in reverse order.
    std::shared_ptr<const world::BlockRegistry> blocks_;
    light::LightTable lights_;
    map::SurfaceKinds kinds_;
    gen::LevelGenerators generators_;
    std::unique_ptr<store::ChunkStore> store_;  // makes tiles of edited chunks until it ends
    map::SurfaceSource surfaces_;
    base::JobSystem jobs_;

    std::mutex editMutex_, settleMutex_;
    std::atomic<bool> hasUnsettledTiles_{false};
    std::once_flag biomesFlag_;
    std::optional<gen::Biomes> biomes_;  // set by the first biomes()
    std::mutex listenerMutex_;
    EditListener listener_;
    std::mutex editedMutex_;
    std::optional<map::EditedPositions> edited_;  // set by the first editedAmong()
};

}  // namespace terrane::volume
