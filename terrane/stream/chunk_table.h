// One record for each chunk that is loaded or being loaded, and the view that orders them: the data that the
// schedulers share. residency.h decides which chunks are loaded and unloaded, depth.h how deep they are made,
// lighting.h which are lit, meshing.h which are meshed again. None of them uses threads, clocks or blocks;
// chunk_pipeline.h runs their work. One thread uses it.
//
//   (absent) ─► Loading ─► Loaded ─► Lighting ─► Visible
//                            ▲ │ ▲──────┘ blocks changed meanwhile
//                            │ ▼
//                            │ (absent): nobody needed it for 5 s
//                            └─────────────────── Visible: the view moved on
//
// Chunks within the view distance become visible, and one ring around them is loaded, since a chunk can be
// lit and meshed only while its eight neighbors are loaded.
#pragma once

#include <array>
#include <chrono>
#include <climits>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "terrane/base/job_system.h"
#include "terrane/stream/chunk_jobs.h"
#include "terrane/stream/view_order.h"

namespace terrane::stream {

using Time = std::chrono::steady_clock::time_point;

enum class ChunkStage : std::uint8_t {
    Loading,   // from the store or the generator
    Loaded,    // its blocks are there
    Lighting,  // it is lit and meshed for the first time
    Visible,   // light and mesh are there
};
constexpr std::size_t kChunkStageCount = 4;

// How deep a loaded chunk is, in sections.
struct LoadedDepths {
    int lowestMade = 0;  // world::Chunk::lowestMade()
    int lowestOpen = 0;  // light::lowestOpenSection()
};

// The sections down to which a chunk and the eight around it are made (lighting.h, neighborhood()).
using DepthsAround = std::array<std::int16_t, 9>;
constexpr std::int16_t kNoDepth = INT16_MAX;  // of chunks beyond the world

struct ChunkRecord {
    // Residency.
    ChunkStage stage = ChunkStage::Loading;
    bool isRequested = false;        // by others than the view: such a load is never cancelled
    Time neededAt{};                 // when somebody last needed the chunk
    base::JobHandle load;            // while the load can be cancelled
    std::optional<Time> editedAt{};  // of the first edit that the store does not have

    // Depth, in sections; of chunks that are not Loading.
    int lowestMade = 0;         // world::Chunk::lowestMade()
    int lowestOpen = 0;         // light::lowestOpenSection()
    int wantedDepth = INT_MAX;  // the lowest one that was requested
    bool isDeepening = false;   // a job makes it deeper

    // Lighting.
    std::uint8_t loadedNeighbors = 0;  // of its eight neighbors; those beyond the world count
    bool isOutdated = false;           // blocks, mesh options or open sides changed after its lighting began
    bool isBeingLit = false;           // for the first time or again
    bool isToLightAgain = false;       // requested after its lighting began
    DepthsAround litDepths{};          // of the 3×3 when its lighting began; none if that was in vain
    LocalLightPtr localLight{};        // null once nobody needs it
    light::ChunkLightPtr light{};      // of visible chunks

    // Meshing again, of visible chunks.
    mesh::MeshSectionSet toMesh{};  // sections that wait to be meshed
    std::uint64_t meshJob = 0;      // the job that meshes all of it; 0: none, or its result is outdated
};

struct ChunkTable {
    world::Heights heights;
    ViewOrder view;
    std::unordered_map<world::ChunkPos, ChunkRecord, world::ChunkPosHash> records;
    std::array<std::size_t, kChunkStageCount> stageCounts{};
    std::size_t chunksInView = 0;   // within the view distance and the world
    std::size_t visibleInView = 0;  // of these

    // Residency: chunks before loadCursor in the view's order are not absent. Requests of others, each once.
    std::size_t loadCursor = 0;
    std::deque<world::ChunkPos> requests;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> requested;

    // Depth: the section that is needed near the camera, nothing if all chunks are made to the bottom. Loaded
    // chunks that want to be deeper; some are listed twice or deep enough.
    std::optional<int> nearDepth;
    std::deque<world::ChunkPos> toDeepen;
    std::size_t depthJobCount = 0;  // on workers

    // Lighting: chunks before lightCursor in the view's order are Lighting or Visible, or not in view.
    // Visible chunks to light again; some are not visible any more.
    std::size_t lightCursor = 0;
    std::deque<world::ChunkPos> toLightAgain;
    std::size_t lightAgainCount = 0;  // on workers

    // Meshing: chunks with `toMesh`, after edits and for other reasons; some are listed twice or already
    // meshed. Jobs are numbered from 1.
    std::deque<world::ChunkPos> editedMeshes, otherMeshes;
    std::uint64_t lastMeshJob = 0;
    std::size_t meshJobCount = 0;  // on workers
};

ChunkRecord* findRecord(ChunkTable& table, world::ChunkPos pos);  // null if absent
const ChunkRecord* findRecord(const ChunkTable& table, world::ChunkPos pos);
std::optional<ChunkStage> stageAt(const ChunkTable& table, world::ChunkPos pos);
bool isAt(const ChunkTable& table, world::ChunkPos pos, ChunkStage stage);
std::size_t countOf(const ChunkTable& table, ChunkStage stage);

// The schedulers call these, which update the counts. A new record is Loading.
ChunkRecord& addRecord(ChunkTable& table, world::ChunkPos pos);
void eraseRecord(ChunkTable& table, world::ChunkPos pos);
void setStage(ChunkTable& table, world::ChunkPos pos, ChunkRecord& record, ChunkStage stage);

}  // namespace terrane::stream
