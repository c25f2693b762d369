// GPU memory of one batch, and the commands that light it. docs/light.md has the algorithm.
// gpu_batch_lighter.cpp uses it on the context's thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/batch_lighter.h"
#include "terrane/light/light_sources.h"
#include "terrane/shared/light_solver.h"
#include "terrane/world/chunk.h"
#include "terrane/world/section.h"

namespace terrane::light_gpu {

// The shaders that solve light read chunks as sections in their packed form, with the opacity and emission of
// blocks in place of their ids. Appends sections of a chunk by their numbers.
void appendChunk(world::PackedSections& packed, const world::Chunk& chunk, std::span<const int> sections,
                 const light::LightTable& table);

// Lists the chunks that are solved together, each once, and their neighbors. It uses no OpenGL.
// The limits are 16×16 neighboring chunks with one chunk around them, because light travels 15 blocks, and
// the light tiles that fit into one dispatch: OpenGL has 65,535 work groups along an axis at least, and eight
// tiles a section with 1 KiB each are 64 MiB. 9 chunks of 256 sections take 18,432 tiles.
constexpr std::size_t kMaxRequests = 16 * 16;
constexpr std::size_t kMaxSolved = 18 * 18;
constexpr std::size_t kMaxSolvedSections = 65535 / shared::kLightTilesPerSection;

struct LightBatch {
    world::Heights heights;
    // Numbers of the sections that are solved in all chunks, from below, at least one. The others need no
    // solver: above the highest of them is open sky in all chunks, and between them and below is rock, opaque
    // blocks without emission. One section of rock stays where there are sections above and below it.
    std::vector<int> sections;
    std::vector<world::ChunkPos> requested;
    std::vector<world::ChunkPtr> chunks;  // the requested ones, in order, then their neighbors
    std::vector<shared::uvec4> beside;  // by chunk: numbers of its neighbors at −x, +x, −y, +y, or kNoChunk
};

// Takes as many requests from the front as fit, at least one. A batch has one snapshot of a chunk, so it ends
// before a request that has another one, or that requests the same chunk again. All chunks have the same
// heights.
LightBatch gatherBatch(std::span<const light::LightRequest> requests, const light::LightTable& table);

struct LightPrograms {
    static base::Result<LightPrograms> create(const gpu::ShaderLoader& shaders);

    gpu::Program sources, firstTiles, spread, pack;
};

class LightWorkspace {
  public:
    bool isFree() const { return requested_.empty(); }
    // Uploads the chunks and submits as many rounds as most batches need, without waiting.
    void start(const LightPrograms& programs, const LightBatch& batch, const light::LightTable& table);
    // Returns whether the result is available (with `wait`: once it is). Submits more rounds while light
    // still spreads.
    bool isFinished(const LightPrograms& programs, bool wait);
    // Returns the results in the order of the batch's requests; the workspace is free again.
    std::vector<light::LightResult> takeResult();

  private:
    void upload(const LightBatch& batch, const light::LightTable& table);
    void makeRoom();
    void bind() const;
    void setState(shared::uint tilesListed);
    void setSources(const LightPrograms& programs);
    void spreadAndPack(const LightPrograms& programs);
    shared::uint resultWord(std::size_t index) const;
    light::LightBrick brickAt(std::size_t entry) const;
    light::ChunkLight lightOf(std::size_t chunk) const;

    world::Heights heights_;
    std::vector<int> solved_;                 // numbers of sections
    std::vector<world::ChunkPos> requested_;  // empty: no batch
    std::size_t chunkCount_ = 0;              // solved chunks
    shared::uint roundsDone_ = 0;
    world::PackedSections input_;
    gpu::Buffer sections_, data_, neighbors_;  // of the batch
    gpu::Buffer levels_, tiles_, lists_;       // grow to the largest batch
    gpu::Buffer state_;
    gpu::ReadbackBuffer result_;  // grows too
    gpu::Fence fence_;
};

}  // namespace terrane::light_gpu
