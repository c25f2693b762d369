// The last 3D passes of a chunk from the top down, as far as somebody wants to see it: each pass makes only
// the layers that the next one reads. Used by generator.cpp; one a thread, as it keeps scratch memory.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "terrane/gen/executor.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/world/chunk.h"

namespace terrane::gen {

// Takes the blocks of a layer, x + 16 y, of height z, and drops the columns of which it has seen enough:
// lower layers may have any blocks there.
using LayerTaker =
    std::function<void(int z, std::span<const world::BlockId, kTileLanes> layer, WantedColumns& wanted)>;

// How many layers below its own a 3D pass reads of the 3D pass before; none where that is not known before it
// runs, or where it reads blocks of neighbors.
std::optional<int> layersReadBelow(const PassGraph& pass);

// Whether the last pass makes blocks. Generators of columns alone have none.
bool canRunDown(const GeneratorGraph& generator);
// The first of the last passes that can run together from the top down, of a generator that can run down.
int firstDownPass(const GeneratorGraph& generator);

class DownPasses {
  public:
    // Refers to its arguments.
    DownPasses(const std::vector<NoiseCall>& noises, const Seeds& seeds, ExecutorParts parts)
        : noises_(noises), seeds_(seeds), parts_(parts) {}

    // Forgets the passes.
    void clear() { count_ = 0; }
    // The next pass, which must be able to run down. Blocks of the pass before are among `inputs` for the
    // first one only. Refers to the arguments until cleared.
    void add(const VoxelPass& pass, PassInputs inputs);
    // Hands out the layers of the last pass, from the top until no column is wanted. Layers that are one
    // block and the same as the one above are left out.
    void run(const LayerTaker& take);

  private:
    struct Running {
        explicit Running(Executor e) : executor(std::move(e)) {}

        Executor executor;
        std::unique_ptr<BlockArray> blocks = std::make_unique_for_overwrite<BlockArray>();
        int readsBelow = 0;
    };
    int reachOf(std::size_t pass) const;
    void makeMore(std::size_t pass);

    const std::vector<NoiseCall>& noises_;
    const Seeds& seeds_;
    ExecutorParts parts_;
    WantedColumns wanted_;
    std::size_t count_ = 0;
    std::vector<std::unique_ptr<Running>> passes_;  // count_ of them run
};

}  // namespace terrane::gen
