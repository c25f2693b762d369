// A pass's graph put in order for the CPU: instructions over tiles of 16×16 columns with registers allocated.
//
// `column` computes values that do not depend on z, once per chunk; `layer` then runs for each z. Only rows
// (16 columns of equal y) in which some lane takes a branch run it. It is made once per generator; read by
// all threads.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"

namespace terrane::gen {

constexpr int kTileSize = 16;                      // columns along x and along y
constexpr int kTileLanes = kTileSize * kTileSize;  // lane = x + 16 y
constexpr int kRowLanes = kTileSize;               // lanes of a row: 64 bytes

// Rows of a tile: bit y for the columns of equal y.
using RowMask = std::uint16_t;
constexpr RowMask kAllRows = 0xFFFF;

// Operands count rows in 16 bits: 65,536 × 64 bytes = 4 MiB.
constexpr std::uint32_t kMaxArenaRows = 65536;

// Location of a value in the arena: rows of 16 lanes of 32 bits. A value that is equal in all columns has one
// row (rowStep 0), others have 16.
struct Operand {
    std::uint16_t row = 0;
    std::uint16_t rowStep = 0;
    bool operator==(const Operand&) const = default;
};

struct Instruction {
    Op op = Op::Constant;
    Operand dst;
    std::array<Operand, 3> args{};
    // Immediate of the operation. Op::Phi and Op::LoopOut stand for a whole if or loop here; theirs is the
    // number of the branch or loop.
    std::uint32_t imm = 0;
};

using InstructionList = std::vector<Instruction>;

struct PhiMove {
    Operand dst, then, otherwise;
};

struct Branch {
    Operand condition;
    InstructionList then, otherwise;
    std::vector<PhiMove> phis;
};

struct LoopMove {
    Operand in, initial, next;
    Operand changed;  // holds the next value until all variables have theirs
};

struct ProgramLoop {
    InstructionList head, body;
    Operand condition;
    std::vector<LoopMove> variables;
};

struct Program {
    bool is3D = false;
    InstructionList column, layer;
    std::vector<Branch> branches;
    std::vector<ProgramLoop> loops;
    std::vector<Bits> constants;  // rows 0… of the arena, each value in all 16 lanes
    Operand x, y, z;              // filled by the executor
    std::uint32_t arenaRows = 0;

    // 3D passes: values that `column` computes for `layer`, which writes no row below `layerRows`.
    struct Input {
        NodeId node;
        Operand value;
    };
    std::vector<Input> inputs;
    std::uint32_t layerRows = 0;

    struct FieldResult {
        std::uint32_t field;
        Operand value;  // in a 3D pass 0 but for one layer of each column
    };
    std::vector<FieldResult> fields;
    std::optional<Operand> block;
    std::vector<std::uint32_t> readsAt;  // fields it reads with an offset
    std::vector<int> rowsAround;         // by these: rows beyond the tile that it reads, up to kMaxReadOffset
    bool readsBlocksAt = false;          // reads blocks with an offset
    std::vector<StampCall> stamps;       // by imm of Op::Stamp
};

// Compiles a pass. A program that needs more than kMaxArenaRows cannot run: GeneratorBuilder::finish()
// refuses it.
Program compile(const PassGraph& pass, const std::vector<NoiseCall>& noises);

// A constant's row in the arena, all 16 lanes of it.
struct RowConstant {
    Operand row;
    Bits value;
};

// Compiles a 3D pass whose graph has the node numbers of another pass (Graph::withKnown). The program runs in
// the same arena after the `column` of `base`, the program of that pass; its own `column` computes only
// values that no longer depend on z. `constants` receives the rows to fill before it runs; base.constants are
// filled already. Program::constants stays empty.
Program compileAfter(const Program& base, const PassGraph& pass, const std::vector<NoiseCall>& noises,
                     std::vector<RowConstant>& constants);

}  // namespace terrane::gen
