// Runs one pass of a generator on one chunk. Each thread has an Executor of its own, which reuses scratch
// memory between calls.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/compile/voxel_pass.h"
#include "terrane/gen/cpu/block_layers.h"
#include "terrane/gen/cpu/kernels.h"
#include "terrane/gen/drainage/drainage_maps.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

// The columns of a tile whose lower layers are requested, while 3D passes run from the top down. At first it
// has all columns; callers drop columns.
class RequestedColumns {
  public:
    RequestedColumns() {
        lanes_.fill(~Bits{0});
        left_.fill(kRowLanes);
    }

    bool has(std::size_t column) const { return lanes_[column] != 0; }  // x + 16 y
    void drop(std::size_t column) {
        if (!has(column)) return;
        lanes_[column] = 0;
        const std::size_t row = column / kRowLanes;
        if (--left_[row] == 0) rows_ = static_cast<RowMask>(rows_ & ~(1u << row));
    }

    RowMask rows() const { return rows_; }               // those with requested columns
    const Bits* lanes() const { return lanes_.data(); }  // all bits of a column, or none; aligned for SIMD

  private:
    alignas(64) std::array<Bits, kTileLanes> lanes_;
    std::array<std::uint8_t, kTileSize> left_;  // requested columns, by row
    RowMask rows_ = kAllRows;
};

// Values of a field in a chunk's columns.
using ColumnValues = std::array<Bits, kTileLanes>;

// Inputs of a pass from its chunk and the eight around it.
struct PassInputs {
    world::ChunkPos chunk;
    // Values of field f in the chunk at (dx, dy) around this one: fields[f][(dy + 1) * 3 + dx + 1]. Only the
    // middle one is set where the pass reads the field without an offset.
    std::vector<std::array<const ColumnValues*, 9>> fields;
    // Blocks of the last earlier 3D pass, in the same order. Only the middle one is set where the pass reads
    // blocks without an offset.
    std::array<const BlockLayers*, 9> blocks{};
};

// Statistics of a slab.
struct SlabRun {
    enum class Way : std::uint8_t {
        Filled,    // one block
        Copied,    // from the 3D pass before
        Repeated,  // one layer was computed
        Short,     // every layer was, by a short pass
        Whole
    };
    Way way;
    int count;                 // layers
    std::size_t instructions;  // of a layer
};

// Tables that some programs need.
struct ExecutorParts {
    const ShapeTable* shapes = nullptr;  // those that stamp
    DrainageMaps* drainages = nullptr;   // those that read drainage maps
};

class Executor {
  public:
    // Refers to its arguments.
    Executor(const std::vector<NoiseCall>& noises, const Seeds& seeds, ExecutorParts parts = {});

    // Runs a 2D pass. The results are in the order of program.fields.
    void run2D(const Program& program, const PassInputs& inputs, std::span<ColumnValues* const> results);
    // Runs a 3D pass in the heights of `result`, whose blocks it replaces. `fieldResults` are those of the
    // fields that the pass writes, in the order of program.fields.
    void run3D(const VoxelPass& pass, const PassInputs& inputs, BlockLayers& result,
               std::span<ColumnValues* const> fieldResults = {});
    // Runs the pass from the top down as far as requested: begin3D(), then runTopDown() until there are
    // enough layers. Writes no fields. It refers to its arguments until then; no other pass runs in between.
    void begin3D(const VoxelPass& pass, const PassInputs& inputs, BlockLayers& result);
    // Computes at least one of the missing layers down to `lowest`, the highest first. Columns that are
    // dropped from `requested` get any blocks.
    void runTopDown(int lowest, const RequestedColumns& requested);
    // Returns the lowest computed layer; the world's top before the first.
    int lowestComputed() const { return lowestComputed_; }
    // Sets whether run3D skips work that cannot change the result. Tests compare both.
    void setShortens(bool shortens) { shortens_ = shortens; }
    // Returns the slabs of the last run3D, from the bottom.
    std::span<const SlabRun> slabs() const { return slabs_; }

  private:
    void prepareTile(const Program& program, const PassInputs& inputs);
    void fillConstants(const Program& program, SampleGrid grid);
    void paintStamps(const Program& program, world::Heights heights);
    void fillWindow(std::uint32_t field, int rowsAround, const PassInputs& inputs);
    Bits* row(Operand o) { return context_.arena + static_cast<std::size_t>(o.row) * kRowLanes; }
    void prepareNoise(std::uint32_t noise);

    void runSlab(int z, int count);
    void runLayers(const Program& program, int z, int count);
    void runShort(const ShortPass& pass, int z, int count);
    void startShort(const ShortPass& pass, int z);
    void continueSlab(int lowest);
    void writeLayer(Operand block, int z);
    void addToField(Operand value, ColumnValues& field);

    struct AlignedRow {
        alignas(64) std::array<Bits, kRowLanes> lanes;
    };

    const std::vector<NoiseCall>& noises_;
    const Seeds& seeds_;
    ExecutorParts parts_;
    std::vector<AlignedRow> arena_;
    TileContext context_;
    SampleGrid grid_;
    SlabRanges ranges_;
    Decisions wholeDecisions_;  // of a slab that was split
    bool shortens_ = true;
    std::vector<SlabRun> slabs_;
    // Arguments of the 3D pass that runs.
    struct TileRun {
        const VoxelPass* pass = nullptr;
        BlockLayers* result = nullptr;
        std::span<ColumnValues* const> fieldResults;
    };
    TileRun run_;
    // State of runTopDown.
    int lowestComputed_ = 0;                // z of the lowest layer that is made
    int nextLayers_ = 0;                    // how many layers the next slab should have
    int slabBottom_ = 0;                    // z of the lowest layer of the slab that is being made
    const Program* slabProgram_ = nullptr;  // makes its layers
};

}  // namespace terrane::gen
