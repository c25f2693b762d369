// Runs single passes of a generator on one chunk with fields, blocks and seeds that the test sets.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "terrane/gen/cpu/executor.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {

// NaN carries a payload that depends on the order of operands, and no block does on it.
inline bool sameFloat(Bits a, Bits b) {
    const bool aIsNaN = (a & 0x7FFFFFFFu) > 0x7F800000u, bIsNaN = (b & 0x7FFFFFFFu) > 0x7F800000u;
    return a == b || (aIsNaN && bIsNaN);
}

// Blocks from the bottom of the world.
struct BlockArray : std::vector<std::uint16_t> {
    explicit BlockArray(world::Heights h = {})
        : std::vector<std::uint16_t>(static_cast<std::size_t>(h.layers()) * kTileLanes), heights(h) {}
    explicit BlockArray(const BlockLayers& layers) : BlockArray(layers.heights()) {
        for (int z = heights.bottom; z < heights.top; ++z) std::copy_n(layers.layer(z), kTileLanes, layer(z));
    }

    std::uint16_t* layer(int z) {
        return data() + static_cast<std::ptrdiff_t>(z - heights.bottom) * kTileLanes;
    }
    const std::uint16_t* layer(int z) const { return const_cast<BlockArray&>(*this).layer(z); }

    BlockLayers layers() const {
        BlockLayers result(heights);
        for (int z = heights.bottom; z < heights.top; ++z) {
            alignas(64) std::array<Bits, kTileLanes> values;
            std::copy_n(layer(z), kTileLanes, values.begin());
            const bool isOne =
                std::all_of(values.begin(), values.end(), [&](Bits b) { return b == values[0]; });
            if (isOne) {
                result.fill(z, 1, static_cast<std::uint16_t>(values[0]));
            } else {
                result.write(z, values.data());
            }
        }
        return result;
    }

    world::Heights heights;
};

class PassRunner {
  public:
    explicit PassRunner(GeneratorGraph g) : graph(std::move(g)) {
        seeds.noises.assign(graph.noises.size(), 0);
        seeds.hashes.assign(graph.hashNames.size(), 0);
        for (std::size_t k = 0; k < seeds.noises.size(); ++k) seeds.noises[k] = noiseSeed(k);
        for (std::size_t k = 0; k < seeds.hashes.size(); ++k) seeds.hashes[k] = hashSeed(k);
        fields.resize(graph.fields.size());
    }

    // Writes a generator whose last pass, which must be 3D, is added here.
    explicit PassRunner(const Write& write)
        : PassRunner(build([&](GeneratorBuilder& g) {
              write(g);
              g.pass3D("last", [](Pass&) {});
          })) {}

    static std::uint32_t noiseSeed(std::size_t k) { return 0x1234567u + 77u * static_cast<std::uint32_t>(k); }
    static std::uint32_t hashSeed(std::size_t k) { return 0xABCDEFu + 99u * static_cast<std::uint32_t>(k); }

    std::vector<ColumnValues> run2D(std::size_t pass) {
        const Program program = compile(graph.passes[pass], graph.noises);
        std::vector<ColumnValues> results(program.fields.size());
        std::vector<ColumnValues*> pointers;
        for (ColumnValues& values : results) pointers.push_back(&values);
        executor().run2D(program, inputs(), pointers);
        return results;
    }

    std::unique_ptr<BlockArray> run3D(std::size_t pass, bool shortens = true) {
        return run3D(graph.passes[pass], VoxelPass(graph.passes[pass], graph.noises), shortens);
    }
    std::unique_ptr<BlockArray> run3D(const PassGraph& pass, const VoxelPass& voxelPass,
                                      bool shortens = true) {
        result_ = BlockLayers(graph.heights);
        writtenFields.resize(pass.fields.size());
        std::vector<ColumnValues*> pointers;
        for (ColumnValues& values : writtenFields) pointers.push_back(&values);
        executor().setShortens(shortens);
        executor().run3D(voxelPass, inputs(), result_, pointers);
        return std::make_unique<BlockArray>(result_);
    }

    std::vector<SlabRun> slabs() const { return {executor_->slabs().begin(), executor_->slabs().end()}; }
    const BlockLayers& layers() const { return result_; }  // of the 3D pass run last

    GeneratorGraph graph;
    Seeds seeds;
    ChunkPos chunk;
    std::vector<ColumnValues> fields;                 // of the chunk, by field
    std::vector<ColumnValues> writtenFields;          // by the 3D pass run last
    std::vector<std::array<ColumnValues, 9>> around;  // by field, where the test sets it: all nine chunks
    std::unique_ptr<BlockArray> blocks;               // of the earlier 3D pass
    std::array<std::unique_ptr<BlockArray>, 9> blocksAround;  // of its neighbors, where the test sets them

  private:
    Executor& executor() {
        if (!executor_)
            executor_ =
                std::make_unique<Executor>(graph.noises, seeds, ExecutorParts{.shapes = graph.shapes.get()});
        return *executor_;
    }

    PassInputs inputs() {
        PassInputs result;
        result.chunk = chunk;
        result.fields.resize(graph.fields.size());
        for (std::size_t f = 0; f < graph.fields.size(); ++f) {
            if (f < fields.size()) result.fields[f][4] = &fields[f];
            if (f >= around.size()) continue;
            for (std::size_t n = 0; n < 9; ++n) result.fields[f][n] = &around[f][n];
        }
        for (std::size_t n = 0; n < 9; ++n) {
            const BlockArray* source = n == 4 ? blocks.get() : blocksAround[n].get();
            if (!source) continue;
            sources_[n] = source->layers();
            result.blocks[n] = &sources_[n];
        }
        return result;
    }

    BlockLayers result_;
    std::array<BlockLayers, 9> sources_;

    std::unique_ptr<Executor> executor_;
};

}  // namespace terrane::gen
