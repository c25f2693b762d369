// Runs the last 3D passes of a chunk from the top down, as far as the caller requests: each pass computes
// only the layers that the next one reads. generator.cpp uses it; each thread has one, since it owns scratch
// memory.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/cpu/executor.h"
#include "terrane/world/chunk.h"

namespace terrane::gen {

// Receives the blocks of layer z, x + 16 y, and drops columns whose lower layers are not needed: these layers
// may have any blocks there.
using LayerCallback = std::function<void(int z, std::span<const world::BlockId, kTileLanes> layer,
                                         RequestedColumns& requested)>;

// Returns the number of layers below its own that a 3D pass reads from the 3D pass before it, not counting
// those at a height that a field has, such as the ground under a tree. Returns nothing if that is not known
// before the pass runs, or if it reads blocks of neighbors.
std::optional<int> layersReadBelow(const PassGraph& pass);
// Returns the lowest layer that the pass reads at heights of fields; the world's top if it reads none.
int lowestFieldRead(const PassGraph& pass, const PassInputs& inputs, world::Heights heights);

// Returns whether the last pass makes blocks. Generators of columns alone have none.
bool canRunTopDown(const GeneratorGraph& generator);
// Returns the number of the first of the last passes that can run together from the top down. Requires
// canRunTopDown().
int firstTopDownPass(const GeneratorGraph& generator);

class TopDownPasses {
  public:
    // Refers to its arguments. `heights`: of the world.
    TopDownPasses(const std::vector<NoiseCall>& noises, const Seeds& seeds, ExecutorParts parts,
                  world::Heights heights)
        : noises_(noises), seeds_(seeds), parts_(parts), heights_(heights) {}

    // Removes the passes.
    void clear() { count_ = 0; }
    // Adds the next pass, which must be able to run from the top down. Blocks of the pass before are among
    // `inputs` for the first one only. Refers to the arguments until cleared.
    void add(const VoxelPass& pass, PassInputs inputs);
    // Passes the layers of the last pass to `take` from the top, until no column is requested. Leaves out
    // layers that are one block and equal the layer above.
    void run(const LayerCallback& take);
    // Makes the layers of the last pass down to z, all columns of them. Not in the same use as run().
    void makeDownTo(int z);
    // Returns the blocks of the last pass, as far down as they are made.
    const BlockLayers& blocks() const { return passes_[count_ - 1]->blocks; }

  private:
    struct Running {
        Running(Executor e, world::Heights heights) : executor(std::move(e)), blocks(heights) {}

        Executor executor;
        BlockLayers blocks;
        int readsBelow = 0;
    };
    int reachOf(std::size_t pass) const;
    void makeDownTo(std::size_t pass, int z);

    const std::vector<NoiseCall>& noises_;
    const Seeds& seeds_;
    ExecutorParts parts_;
    world::Heights heights_;
    RequestedColumns requested_;
    std::size_t count_ = 0;
    std::vector<std::unique_ptr<Running>> passes_;  // count_ of them run
};

}  // namespace terrane::gen
