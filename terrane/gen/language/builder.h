// Writes a generator: a list of passes over columns (2D) and voxels (3D), as C++ expressions.
//
// clang-format off
//   GeneratorBuilder g("hills", blocks);
//   auto height = g.field<Float>("height");
//   g.pass2D("terrain", [&](Pass& p) {
//       p.set(height, 80.0f + 20.0f * p.perlin2D("hills", 64, {1.0f, 2.0f}));
//   });
//   g.pass3D("ground", [&](Pass& p) {
//       p.setBlock(select(Float(p.z()) <= p.read(height), p.block("stone"), p.block("air")));
//   });
//   auto generator = g.finish();
// clang-format on
//
// A generator is recorded once for each level of detail; at level k its columns lie 2^k blocks apart.
//
// Used on one thread. Mistakes (unknown block, offset too large, a name used twice, a value of another pass,
// more values at once than there are registers) are collected and reported by finish(), each with pass and
// name.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/language/pass.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::gen {

// Nesting depth of the branches and loops of a scheduled pass. The compiler, the executor and GLSL compilers
// recurse once per level, so GeneratorBuilder::finish() refuses passes that nest too deeply. Any thread may
// use it. Levels of the schedule of a whole pass. Sequential ifs nest where one uses the result of another on
// one side alone.
constexpr int kMaxBranchDepth = 64;
// Ifs and loops along one path from a node to its arguments: no schedule of a part of the pass is deeper.
// Parts with known conditions (voxel_pass.h) are compiled again, and their nodes may stand deeper than in the
// whole pass. 1,024 levels of the compiler take about half a megabyte of stack.
constexpr int kMaxBranchChain = 1024;

// These return the levels below the root. Both functions work without recursion.
int branchDepth(const PassGraph& pass);
int branchChain(const PassGraph& pass);

// Returns the reason if a pass nests too deeply, else empty.
std::string branchMistake(const PassGraph& pass);

// The tint of a generator (GeneratorBuilder::tint) as a graph of its own: chunks do not compute it, and it
// needs no chunks. Any thread may use it.
struct TintGraph {
    GeneratorGraph passes;    // 2D passes alone, of the same level
    std::uint32_t field = 0;  // what they make: packed colors (world/tint.h)
};

// Sets generator.tint for a field of type Int, and removes the parts of the generator that only the tint
// needs. Returns the reason if the field is no tint, else an empty string.
std::string extractTint(GeneratorGraph& generator, std::uint32_t field);

class GeneratorBuilder {
  public:
    // Records the graph of one level, 0…world::kMaxLevel, and of a world's heights: a generator is written
    // once and recorded for each.
    GeneratorBuilder(std::string name, const world::BlockRegistry& blocks, GraphRequest request = {});
    GeneratorBuilder(std::string name, const world::BlockRegistry& blocks, int level)
        : GeneratorBuilder(std::move(name), blocks, GraphRequest{level, {}}) {}

    // Returns the number of blocks from one column to the next: 2^level. It is a constant while recording, so
    // `if` on it omits the other branch.
    int step() const { return world::columnWidth(generator_.level); }
    // Returns the heights that it records for, constants like step().
    world::Heights heights() const { return generator_.heights; }
    // Sets the heights of worlds that do not name their own; before the first pass.
    void declareHeights(world::Heights heights);

    template <class T>
    Field<T> field(std::string_view name) {
        return {newField(name, T::kType)};
    }
    // Adds a map of rivers and lakes for Pass::drainage over the heights, in blocks, that `height` records.
    // It runs at every spacing / 2 blocks, for which p.step() stands, whatever the generator's level is:
    // positions, noise and random numbers, no fields. With `gradient`, likewise recorded, the map has
    // valleys: it is how steep a stream with a single node upstream is, blocks a block, 0 or more.
    Drainage drainage(const std::string& name, const DrainageSpec& spec,
                      const std::function<Float(Pass&)>& height,
                      const std::function<Float(Pass&)>& gradient = {});
    // Sets the color of each column for tinted blocks (docs/worldgen.md): a field of packColor(), once a
    // generator. Chunks do not contain it: only LevelGenerators::tint() computes it.
    template <class T>
    void tint(Field<T> colors) {
        setTint(colors.index, T::kType);
    }
    void pass2D(std::string name, const std::function<void(Pass&)>& body) {
        addPass(std::move(name), false, body);
    }
    void pass3D(std::string name, const std::function<void(Pass&)>& body) {
        addPass(std::move(name), true, body);
    }

    // Adds a shape that passes can stamp. Returns its number: 0, 1, 2 … in the order of the calls, at most
    // kMaxShapes.
    int shape(const VoxelShape& shape);

    // Returns the mistakes so far, one line each. terrane/lua adds the line of the script whose call made
    // one.
    const std::vector<std::string>& mistakes() const { return errors_; }
    // Returns the generator as far as it is recorded. Valid only without mistakes.
    const GeneratorGraph& recorded() const { return generator_; }

    [[nodiscard]] base::Result<GeneratorGraph> finish();

  private:
    friend class Pass;
    void setHeights(world::Heights heights);
    int last3DPass() const;  // number of the last finished 3D pass, or -1
    std::uint32_t newField(std::string_view name, Type type);
    void setTint(std::uint32_t field, Type type);
    void addPass(std::string name, bool is3D, const std::function<void(Pass&)>& body);
    // Returns the call with the weights of the level. If the call has a mistake, notes it and returns a valid
    // call instead. A name belongs to one noise.
    NoiseCall checkedNoise(Pass& pass, std::string_view kind, NoiseCall call);
    std::uint32_t noiseIndex(const NoiseCall& call);
    std::uint32_t hashSlot(const std::string& seedName);
    void checkBranches(const GeneratorGraph& generator);
    void checkRegisters();
    void makeShapeTable();

    GeneratorGraph generator_;
    world::RequestedHeights requestedHeights_;
    bool declaresHeights_ = false;
    std::string heightsMistake_;  // in the requested and the declared ones together
    const world::BlockRegistry& blocks_;
    std::optional<std::uint32_t> tint_;                   // field
    std::map<std::string, std::string> noiseParameters_;  // by name: kind and parameters
    std::vector<VoxelShape> shapes_;
    std::vector<std::unique_ptr<Pass>>
        written_;  // kept: expressions that outlive their pass point to its graph
    std::vector<std::string> errors_;
};

}  // namespace terrane::gen
