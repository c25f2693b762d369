// GPU memory of one batch, and the commands that light it. docs/light.md has the algorithm. Used by
// gpu_batch_lighter.cpp on the context's thread.
#pragma once

#include <vector>

#include "terrane/base/result.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/fence.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light_gpu/light_batch_internal.h"
#include "terrane/light_gpu/section_upload_internal.h"

namespace terrane::light_gpu {

struct LightPrograms {
    static base::Result<LightPrograms> create(const gpu::ShaderLoader& shaders);

    gpu::Program sources, firstTiles, spread, pack;
};

class LightWorkspace {
  public:
    bool isFree() const { return requested_.empty(); }
    // Uploads the chunks and submits as many rounds as most batches need, without waiting.
    void start(const LightPrograms& programs, const LightBatch& batch, const light::LightTable& table);
    // Whether the result is available (with `wait`: once it is). Submits more rounds while light still
    // spreads.
    bool isFinished(const LightPrograms& programs, bool wait);
    // Returns the results in the order of the batch's requests; the workspace is free again.
    std::vector<light::LightResult> takeResult();

  private:
    void upload(const LightBatch& batch, const light::LightTable& table);
    void makeRoom();
    void bind() const;
    void setSources(const LightPrograms& programs);
    void spreadAndPack(const LightPrograms& programs);
    shared::uint resultWord(std::size_t index) const;
    light::LightBrick brickAt(std::size_t entry) const;

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
