// One noise call over one tile, by the kernels of the chosen instruction set: every bit of every result.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/gen/cpu/kernels.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {

class NoiseTile {
  public:
    NoiseTile(const NoiseCall& call, std::uint32_t seed) : call_(call), seed_(seed) {
        context_.perlin2D.resize(1);
        context_.perlin3D.resize(1);
        context_.voronoi2D.resize(1);
        context_.voronoi3D.resize(1);
        context_.simplex2D.resize(1);
        context_.noiseKinds = {call.kind};
        context_.isPrepared = {1};
        context_.arena = arena_.data();
        list_.push_back({Op::Noise, {0, 1}, {}, 0});
    }

    void moveTo(ChunkPos chunk) {
        chunk_ = chunk;
        const SampleGrid grid = sampleGrid(chunk);
        if (call_.kind == NoiseKind::Perlin2D) prepare(context_.perlin2D[0], call_, seed_, grid);
        if (call_.kind == NoiseKind::Perlin3D) prepare(context_.perlin3D[0], call_, seed_, grid);
        if (call_.kind == NoiseKind::Voronoi2D) prepare(context_.voronoi2D[0], call_, seed_, grid);
        if (call_.kind == NoiseKind::Voronoi3D) prepare(context_.voronoi3D[0], call_, seed_, grid);
        if (call_.kind == NoiseKind::Simplex2D) prepare(context_.simplex2D[0], call_, seed_, grid);
    }

    // Samples the columns (2D) or the layer z (3D).
    void run(std::int32_t z = 0) {
        context_.z = z;
        runInstructions(list_, context_);
    }

    Bits at(int x, int y, std::uint32_t component = 0) const {
        return arena_[component * kTileLanes + static_cast<std::size_t>(x + kTileSize * y)];
    }
    float floatAt(int x, int y, std::uint32_t component = 0) const { return asFloat(at(x, y, component)); }

    ChunkPos chunk() const { return chunk_; }
    std::size_t pointCount() const { return context_.voronoi2D[0].points.size(); }

  private:
    NoiseCall call_;
    std::uint32_t seed_;
    ChunkPos chunk_;
    alignas(64) std::array<Bits, kVoronoi3DResultCount * kTileLanes> arena_{};
    TileContext context_;
    InstructionList list_;
};

}  // namespace terrane::gen
