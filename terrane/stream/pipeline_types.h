// Input and output of the chunk pipeline (chunk_pipeline.h): plain values.
#pragma once

#include <cstddef>

#include "terrane/base/job_system.h"
#include "terrane/gen/batch_generator.h"
#include "terrane/light/batch_lighter.h"
#include "terrane/stream/chunk_jobs.h"
#include "terrane/world/world.h"

namespace terrane::stream {

// A change of a chunk on screen. A null member is unchanged.
struct ChunkChange {
    world::ChunkPos pos;
    MeshPtr mesh;
    mesh::MeshSectionSet meshSections{};  // of the mesh that changed; the others have no quads in it
    bool needsMesh = false;               // the taker of the change is to make the mesh: see MeshPolicy
    light::ChunkLightPtr light;
    world::SectionSet bricks{};  // of the light that changed
    bool isHidden = false;       // it is no longer on screen
};

struct Progress {
    std::size_t inView = 0;     // chunks within the view distance
    std::size_t visible = 0;    // of these, lit and meshed
    std::size_t remaining = 0;  // what may still change visible chunks
    bool complete() const { return visible == inView; }
    bool isUpToDate() const { return complete() && remaining == 0; }
};

// The work on one kind of task so far.
struct TaskTime {
    const char* name = "";
    std::size_t count = 0;
    double microseconds = 0;  // of all
};

// Selects who meshes whole chunks: workers, or the receiver of the changes, for example on the GPU, from
// ChunkPipeline::meshBlocks(). The pipeline meshes sections that edits touch either way, so that edits are
// visible in the next frame.
enum class MeshPolicy : std::uint8_t { Workers, Caller };

// The parts that the pipeline uses; all outlive it.
struct PipelineParts {
    base::JobSystem& jobs;
    const world::BlockRegistry& blocks;
    const light::LightTable& lights;
    world::World& world;
    ChunkSource source;
    gen::BatchGenerator* batchGenerator = nullptr;  // null: workers generate, with source.generator
    light::BatchLighter* batchLighter = nullptr;    // null: workers light
    MeshPolicy meshing = MeshPolicy::Workers;
};

}  // namespace terrane::stream
