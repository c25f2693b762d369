#include "terrane/gen/cpu/executor.h"

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
    assert(!program.is3D && results.size() == program.fields.size() &&
           "a result for each field of a 2D pass");
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

namespace {

// Slabs begin as high as a section. They double where that decides all choices, and are split as far as
// kLowestSlab where fewer layers may decide more: analyzing each layer would cost more than it saves. Slabs
// of one block cost nothing beside their analysis: sky and rock of a tall world are a few of them.
constexpr int kLowestSlab = 4, kFirstSlab = world::kSectionSize, kHighestSlab = 64, kHighestFilledSlab = 1024;

int heightAfter(int height, bool isSettled, bool isFilled) {
    if (!isSettled) return height;
    return std::min(2 * height, isFilled ? kHighestFilledSlab : std::max(height, kHighestSlab));
}

}  // namespace

void Executor::begin3D(const VoxelPass& pass, const PassInputs& inputs, BlockLayers& result) {
    const Program& program = pass.program();
    assert(program.is3D && program.block && "a 3D pass has blocks");
    prepareTile(program, inputs);
    paintStamps(program, result.heights());
    runInstructions(program.column, context_);
    ranges_.begin(pass.plan(), context_.arena, context_.blocks, context_.stamps);
    slabs_.clear();
    result.clear();
    run_ = {&pass, &result, {}};
    lowestComputed_ = slabBottom_ = result.heights().top;
    nextLayers_ = kFirstSlab;
}

void Executor::run3D(const VoxelPass& pass, const PassInputs& inputs, BlockLayers& result,
                     std::span<ColumnValues* const> fieldResults) {
    assert(fieldResults.size() == pass.program().fields.size() && "a result for each field");
    for (ColumnValues* field : fieldResults) field->fill(0);
    begin3D(pass, inputs, result);
    run_.fieldResults = fieldResults;
    const world::Heights heights = result.heights();
    if (!shortens_) {
        slabs_.push_back({SlabRun::Way::Whole, heights.layers(), pass.layerInstructions()});
        return runLayers(pass.program(), heights.bottom, heights.layers());
    }
    int height = kFirstSlab, whole = 0;  // `whole`: of the slab that was split, 0: none
    for (int z = heights.bottom; z < heights.top;) {
        height = std::min(height, heights.top - z);
        ranges_.analyze(z, height);
        if (!ranges_.isSettled() && height > kLowestSlab) {
            whole = height;
            wholeDecisions_ = ranges_.decisions();
            height = std::max(height / 4, kLowestSlab);
            continue;
        }
        // Where the first and the last part decide no more than the whole, as on steep land, the parts
        // between are not looked at.
        const auto isLikeWhole = [&] { return !ranges_.block() && ranges_.decisions() == wholeDecisions_; };
        bool isAlike = whole > 0 && isLikeWhole();
        if (isAlike) {
            ranges_.analyze(z + whole - height, height);
            isAlike = isLikeWhole();
            if (!isAlike) ranges_.analyze(z, height);
        }
        if (isAlike) height = whole;
        whole = 0;
        runSlab(z, height);
        z += height;
        if (isAlike) continue;
        height = heightAfter(height, ranges_.isSettled(), slabs_.back().way == SlabRun::Way::Filled);
        if (!ranges_.isSettled() && z % kFirstSlab == 0) height = kFirstSlab;
    }
}

// A slab that must be computed layer by layer is made a few layers at a time, as the caller may need no more;
// its analysis holds for the rest. Slabs are not split below kFirstSlab: rows without requested columns skip
// branches anyway.
void Executor::runTopDown(int lowest, const RequestedColumns& requested) {
    context_.rows = requested.rows();
    context_.requested = requested.lanes();
    assert(run_.pass && lowest >= run_.result->heights().bottom && lowest < lowestComputed_ &&
           "begin3D() comes first, and layers go down");
    if (lowestComputed_ > slabBottom_) return continueSlab(std::max(lowest, slabBottom_));
    int height = std::min(nextLayers_, lowestComputed_ - lowest);
    ranges_.analyze(lowestComputed_ - height, height);
    while (!ranges_.isSettled() && height > kFirstSlab) {
        height = std::max(height / 4, kFirstSlab);
        ranges_.analyze(lowestComputed_ - height, height);
    }
    slabs_.clear();
    slabBottom_ = lowestComputed_ - height;
    slabProgram_ = nullptr;
    if (!ranges_.block()) {
        const ShortPass* pass = run_.pass->find(ranges_.decisions());
        if (!pass) slabProgram_ = &run_.pass->program();
        if (pass && pass->kind == ShortPass::Kind::EachLayer) {
            slabProgram_ = &pass->program;
            startShort(*pass, slabBottom_);
        }
    }
    nextLayers_ = kFirstSlab;
    if (slabProgram_) return continueSlab(std::max(lowest, slabBottom_));
    runSlab(slabBottom_, height);
    if (ranges_.isSettled())
        nextLayers_ = heightAfter(height, true, slabs_.back().way == SlabRun::Way::Filled);
    lowestComputed_ = slabBottom_;
}

void Executor::continueSlab(int lowest) {
    const int count = std::min(lowestComputed_ - lowest, kLowestSlab);
    context_.program = slabProgram_;
    runLayers(*slabProgram_, lowestComputed_ - count, count);
    context_.program = &run_.pass->program();
    lowestComputed_ -= count;
}

// Computes only what the analysis in ranges_ leaves open.
void Executor::runSlab(int z, int count) {
    bool writesNothing = true;
    for (std::size_t k = 0; k < run_.fieldResults.size(); ++k) {
        writesNothing = writesNothing && ranges_.writesNothing(k);
    }
    const std::optional<std::uint16_t> block = ranges_.block();
    if (block && writesNothing) {
        run_.result->fill(z, count, *block);
        slabs_.push_back({SlabRun::Way::Filled, count, 0});
        return;
    }
    const ShortPass* pass = run_.pass->find(ranges_.decisions());
    if (pass) {
        runShort(*pass, z, count);
    } else {
        runLayers(run_.pass->program(), z, count);
        slabs_.push_back({SlabRun::Way::Whole, count, run_.pass->layerInstructions()});
    }
}

void Executor::runShort(const ShortPass& pass, int z, int count) {
    const Program& program = pass.program;
    const std::size_t instructions = pass.layerInstructions;
    if (pass.kind == ShortPass::Kind::CopyBlocks) {
        run_.result->copy(*context_.blocks, z, count);
        slabs_.push_back({SlabRun::Way::Copied, count, 0});
        return;
    }
    startShort(pass, z);
    if (pass.kind == ShortPass::Kind::OneLayer) {
        runLayers(program, z, 1);
        run_.result->repeat(z, count);
        slabs_.push_back({SlabRun::Way::Repeated, count, instructions});
    } else {
        runLayers(program, z, count);
        slabs_.push_back({SlabRun::Way::Short, count, instructions});
    }
    context_.program = &run_.pass->program();
}

// Computes values that all layers of the pass share. `z`: any of these layers.
void Executor::startShort(const ShortPass& pass, int z) {
    const Program& program = pass.program;
    if (arena_.size() < program.arenaRows) {
        arena_.resize(program.arenaRows);
        context_.arena = arena_.front().lanes.data();
        ranges_.moveArena(context_.arena);
    }
    context_.program = &program;
    for (const RowConstant& c : pass.constants) arena_[c.row.row].lanes.fill(c.value);
    context_.z = z;
    runInstructions(program.column, context_);
}

void Executor::runLayers(const Program& program, int z, int count) {
    for (int end = z + count; z < end; ++z) {
        context_.z = z;
        std::fill_n(row(program.z), kRowLanes, bitsOf(z));
        runInstructions(program.layer, context_);
        writeLayer(*program.block, z);
        for (std::size_t k = 0; k < run_.fieldResults.size(); ++k) {
            addToField(program.fields[k].value, *run_.fieldResults[k]);
        }
    }
}

// A column's value is 0 in all layers but one.
void Executor::addToField(Operand value, ColumnValues& field) {
    for (int lane = 0; lane < kTileLanes; ++lane) {
        const int at = value.rowStep ? lane : lane % kRowLanes;
        field[static_cast<std::size_t>(lane)] |= row(value)[at];
    }
}

void Executor::writeLayer(Operand block, int z) {
    if (block.rowStep != 0) return run_.result->write(z, row(block));
    run_.result->fill(z, 1, static_cast<std::uint16_t>(*row(block)));
}

void Executor::prepareTile(const Program& program, const PassInputs& inputs) {
    if (arena_.size() < program.arenaRows) arena_.resize(program.arenaRows);
    context_.program = &program;
    context_.rows = kAllRows;
    context_.requested = nullptr;
    context_.arena = arena_.front().lanes.data();
    context_.blocksAround = inputs.blocks;
    context_.blocks = inputs.blocks[4];
    grid_ = sampleGrid(inputs.chunk);
    fillConstants(program, grid_);
    context_.isPrepared.assign(noises_.size(), 0);
    context_.prepareNoise = [this](std::uint32_t noise) { prepareNoise(noise); };  // executors may have moved
    context_.fields.resize(inputs.fields.size());
    context_.windows.resize(inputs.fields.size());
    for (std::size_t f = 0; f < inputs.fields.size(); ++f) {
        const ColumnValues* own = inputs.fields[f][4];
        context_.fields[f] = own ? own->data() : nullptr;
    }
    for (std::size_t k = 0; k < program.readsAt.size(); ++k)
        fillWindow(program.readsAt[k], program.rowsAround[k], inputs);
}

void Executor::paintStamps(const Program& program, world::Heights heights) {
    assert((program.stamps.empty() || parts_.shapes) && "a generator that stamps has shapes");
    if (context_.stamps.size() < program.stamps.size()) context_.stamps.resize(program.stamps.size());
    for (std::size_t k = 0; k < program.stamps.size(); ++k) {
        const StampCall& call = program.stamps[k];
        context_.stamps[k].paint(*parts_.shapes, heights, context_.windows[call.shape],
                                 context_.windows[call.base]);
    }
}

void Executor::prepareNoise(std::uint32_t noise) {
    const NoiseCall& call = noises_[noise];
    const std::uint32_t seed = seeds_.noises[noise];
    switch (call.kind) {
        case NoiseKind::Perlin2D:
            return prepare(context_.perlin2D[noise], call, seed, grid_);
        case NoiseKind::Perlin3D:
            return prepare(context_.perlin3D[noise], call, seed, grid_);
        case NoiseKind::Voronoi2D:
            return prepare(context_.voronoi2D[noise], call, seed, grid_);
        case NoiseKind::Voronoi3D:
            return prepare(context_.voronoi3D[noise], call, seed, grid_);
        case NoiseKind::Simplex2D:
            return prepare(context_.simplex2D[noise], call, seed, grid_);
        case NoiseKind::Stripes2D:
            return prepare(context_.stripes2D[noise], call, seed, grid_);
        case NoiseKind::Drainage:
        case NoiseKind::Valleys:
            assert(parts_.drainages && "a program that reads maps is run with them");
            return parts_.drainages->prepare(
                context_.drainage[noise], static_cast<std::uint32_t>(call.size), grid_,
                {call.kind == NoiseKind::Drainage, call.kind == NoiseKind::Valleys});
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

void Executor::fillWindow(std::uint32_t field, int rowsAround, const PassInputs& inputs) {
    static_assert(kMaxReadOffset == kTileSize, "a window is 3×3 chunks");
    std::vector<Bits>& window = context_.windows[field];
    window.resize(static_cast<std::size_t>(kWindowSize) * kWindowSize);
    for (int chunk = 0; chunk < 9; ++chunk) {
        const ColumnValues* values = inputs.fields[field][static_cast<std::size_t>(chunk)];
        assert(values && "fields read with an offset are there for all nine chunks");
        Bits* corner = window.data() + (chunk / 3) * kTileSize * kWindowSize + (chunk % 3) * kTileSize;
        const int first = chunk < 3 ? kTileSize - rowsAround : 0, end = chunk < 6 ? kTileSize : rowsAround;
        for (int r = first; r < end; ++r) {
            std::memcpy(corner + r * kWindowSize, values->data() + r * kRowLanes, kRowLanes * sizeof(Bits));
        }
    }
}

}  // namespace terrane::gen
