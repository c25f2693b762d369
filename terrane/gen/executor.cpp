#include "terrane/gen/executor.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>

namespace terrane::gen {

Executor::Executor(const std::vector<NoiseCall>& noises, const Seeds& seeds, ExecutorParts parts)
    : noises_(noises), seeds_(seeds), parts_(parts) {
    context_.hashSeeds = seeds.hashes;
    context_.perlin2D.resize(noises.size());
    context_.perlin3D.resize(noises.size());
    context_.voronoi2D.resize(noises.size());
    context_.voronoi3D.resize(noises.size());
    context_.simplex2D.resize(noises.size());
    context_.stripes2D.resize(noises.size());
    context_.drainage.resize(noises.size());
    for (const NoiseCall& call : noises) context_.noiseKinds.push_back(call.kind);
}

void Executor::run2D(const Program& program, const PassInputs& inputs,
                     std::span<ColumnValues* const> results) {
    assert(!program.is3D && results.size() == program.fields.size());
    prepareTile(program, inputs);
    runInstructions(program.column, context_);
    for (std::size_t k = 0; k < results.size(); ++k) {
        const Operand value = program.fields[k].value;
        for (int r = 0; r < kTileSize; ++r) {
            std::memcpy(results[k]->data() + r * kRowLanes, row(value) + value.rowStep * r * kRowLanes,
                        kRowLanes * sizeof(Bits));
        }
    }
}

void Executor::run3D(const Program& program, const PassInputs& inputs, BlockArray& result,
                     std::span<ColumnValues* const> fieldResults) {
    assert(program.is3D && program.block && fieldResults.size() == program.fields.size());
    prepareTile(program, inputs);
    for (ColumnValues* field : fieldResults) field->fill(0);
    runInstructions(program.column, context_);
    // Fields are written from layers too.
    const bool maySkip = program.fields.empty();
    if (maySkip)
        layerRanges_.begin(program, context_.arena, context_.noiseKinds, context_.blocks, context_.stamps);
    for (int z = 0; z < world::kChunkHeight;) {
        const int certain = maySkip ? fillCertain(z, result) : 0;
        if (certain > 0) {
            z += certain;
            continue;
        }
        context_.z = z;
        std::fill_n(row(program.z), kRowLanes, bitsOf(z));
        runInstructions(program.layer, context_);
        writeLayer(*program.block, result.data() + z * kTileLanes);
        for (std::size_t k = 0; k < fieldResults.size(); ++k) {
            addToField(program.fields[k].value, *fieldResults[k]);
        }
        ++z;
    }
}

// A section's layers at once, where z begins one, else the layer z. Returns how many layers that were.
int Executor::fillCertain(int z, BlockArray& result) {
    int count = z % world::kSectionSize == 0 ? world::kSectionSize : 1;
    std::optional<std::uint16_t> block = layerRanges_.blockOfLayers(z, count);
    if (!block && count > 1) block = layerRanges_.blockOfLayers(z, count = 1);
    if (!block) return 0;
    std::uint16_t* layers = result.data() + z * kTileLanes;
    std::fill_n(layers, kTileLanes, *block);
    for (int k = 1; k < count; ++k)
        std::memcpy(layers + k * kTileLanes, layers, kTileLanes * sizeof(*layers));
    return count;
}

// A column's value is 0 in all layers but one.
void Executor::addToField(Operand value, ColumnValues& field) {
    for (int lane = 0; lane < kTileLanes; ++lane) {
        const int at = value.rowStep ? lane : lane % kRowLanes;
        field[static_cast<std::size_t>(lane)] |= row(value)[at];
    }
}

void Executor::writeLayer(Operand block, std::uint16_t* layer) {
    const Bits* values = row(block);
    if (block.rowStep == 0) {
        std::fill_n(layer, kTileLanes, static_cast<std::uint16_t>(*values));
        return;
    }
    std::array<std::uint16_t, kTileLanes> blocks;
    for (std::size_t lane = 0; lane < kTileLanes; ++lane)
        blocks[lane] = static_cast<std::uint16_t>(values[lane]);
    std::memcpy(layer, blocks.data(), sizeof(blocks));
}

void Executor::prepareTile(const Program& program, const PassInputs& inputs) {
    if (arena_.size() < program.arenaRows) arena_.resize(program.arenaRows);
    context_.program = &program;
    context_.arena = arena_.front().lanes.data();
    for (std::size_t n = 0; n < inputs.blocks.size(); ++n) {
        context_.blocksAround[n] = inputs.blocks[n] ? inputs.blocks[n]->data() : nullptr;
    }
    context_.blocks = context_.blocksAround[4];
    const SampleGrid grid = sampleGrid(inputs.chunk);
    fillConstants(program, grid);
    for (const std::uint32_t n : program.noises) {
        const NoiseCall& call = noises_[n];
        const std::uint32_t seed = seeds_.noises[n];
        switch (call.kind) {
            case NoiseKind::Perlin2D:
                prepare(context_.perlin2D[n], call, seed, grid);
                break;
            case NoiseKind::Perlin3D:
                prepare(context_.perlin3D[n], call, seed, grid);
                break;
            case NoiseKind::Voronoi2D:
                prepare(context_.voronoi2D[n], call, seed, grid);
                break;
            case NoiseKind::Voronoi3D:
                prepare(context_.voronoi3D[n], call, seed, grid);
                break;
            case NoiseKind::Simplex2D:
                prepare(context_.simplex2D[n], call, seed, grid);
                break;
            case NoiseKind::Stripes2D:
                prepare(context_.stripes2D[n], call, seed, grid);
                break;
            case NoiseKind::Drainage:
                assert(parts_.drainages && "a program that reads maps is run with them");
                parts_.drainages->prepare(context_.drainage[n], static_cast<std::uint32_t>(call.size), grid);
                break;
        }
    }
    context_.fields.resize(inputs.fields.size());
    context_.windows.resize(inputs.fields.size());
    for (std::size_t f = 0; f < inputs.fields.size(); ++f) {
        const ColumnValues* own = inputs.fields[f][4];
        context_.fields[f] = own ? own->data() : nullptr;
    }
    for (const std::uint32_t f : program.readsAt) fillWindow(f, inputs);
    paintStamps(program);
}

void Executor::paintStamps(const Program& program) {
    assert((program.stamps.empty() || parts_.shapes) && "a generator that stamps has shapes");
    if (context_.stamps.size() < program.stamps.size()) context_.stamps.resize(program.stamps.size());
    for (std::size_t k = 0; k < program.stamps.size(); ++k) {
        const StampCall& call = program.stamps[k];
        context_.stamps[k].paint(*parts_.shapes, context_.windows[call.shape], context_.windows[call.base]);
    }
}

void Executor::fillConstants(const Program& program, SampleGrid grid) {
    for (std::size_t k = 0; k < program.constants.size(); ++k) arena_[k].lanes.fill(program.constants[k]);
    for (int r = 0; r < kTileSize; ++r) {
        for (int lane = 0; lane < kRowLanes; ++lane) {
            row(program.x)[r * kRowLanes + lane] = bitsOf(grid.x + lane * grid.step);
            row(program.y)[r * kRowLanes + lane] = bitsOf(grid.y + r * grid.step);
        }
    }
}

void Executor::fillWindow(std::uint32_t field, const PassInputs& inputs) {
    static_assert(kMaxReadOffset == kTileSize, "a window is 3×3 chunks");
    std::vector<Bits>& window = context_.windows[field];
    window.resize(static_cast<std::size_t>(kWindowSize) * kWindowSize);
    for (int chunk = 0; chunk < 9; ++chunk) {
        const ColumnValues* values = inputs.fields[field][static_cast<std::size_t>(chunk)];
        assert(values && "fields read with an offset are there for all nine chunks");
        Bits* corner = window.data() + (chunk / 3) * kTileSize * kWindowSize + (chunk % 3) * kTileSize;
        for (int r = 0; r < kTileSize; ++r) {
            std::memcpy(corner + r * kWindowSize, values->data() + r * kRowLanes, kRowLanes * sizeof(Bits));
        }
    }
}

}  // namespace terrane::gen
