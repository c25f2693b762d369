// The memory of one batch on the GPU, and the commands that light it. docs/light.md tells how. Used by
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
    // Gives the GPU all that most batches need; nothing waits. The chunks are uploaded.
    void start(const LightPrograms& programs, const LightBatch& batch, const light::LightTable& table);
    // Whether the result is there (with `wait`: once it is). Where light still spreads the GPU gets more
    // rounds.
    bool isFinished(const LightPrograms& programs, bool wait);
    // The result in the order of the batch's requests; the workspace is free again.
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
    std::size_t chunkCount_ = 0;              // that are solved
    shared::uint roundsDone_ = 0;
    world::PackedSections input_;
    gpu::Buffer sections_, data_, neighbors_;  // of the batch
    gpu::Buffer levels_, cells_, lists_;       // grow to the largest batch
    gpu::Buffer state_;
    gpu::ReadbackBuffer result_;  // grows too
    gpu::Fence fence_;
};

}  // namespace terrane::light_gpu
