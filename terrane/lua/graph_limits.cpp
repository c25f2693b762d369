#include "terrane/lua/graph_limits_internal.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/gen/noise/noise.h"
#include "terrane/world/coords.h"

namespace terrane::lua {
namespace {

// The cost of a call of noise in additions, roughly.
double operationsOf(const gen::NoiseCall& call) {
    switch (call.kind) {
        case gen::NoiseKind::Voronoi2D:
            return 30.0 * call.maxPoints;
        case gen::NoiseKind::Voronoi3D:
            return 300.0 * call.maxPoints;
        case gen::NoiseKind::Drainage:
            return 100;
        case gen::NoiseKind::Valleys:
            return 6000;  // some 150 pieces of streams, 40 operations each
        case gen::NoiseKind::Stripes2D:
            return 400;  // nine cells and more, some 40 operations each
        default:
            return 10.0 * static_cast<double>(call.weights.size() + 1);
    }
}

// The number of loops around a node. Each may run kMaxLoopRounds times.
int depthOf(const gen::Graph& graph, const gen::Node& node) {
    if (node.loop == gen::kNoLoop) return 0;
    return graph.loops()[static_cast<std::size_t>(node.loop)].depth;
}

double voxelsOf(const gen::GeneratorGraph& graph) {
    return graph.heights.layers() * static_cast<double>(world::kBlocksPerLayer);
}

struct PassWork {
    double operationsPerVoxel = 0;
    int loopDepth = 0;
};

// `columns`: columns that are computed for a chunk, divided by its voxels.
PassWork workOf(const gen::PassGraph& pass, const std::vector<gen::NoiseCall>& noises, double columns) {
    PassWork work;
    for (gen::NodeId id = 0; id < pass.graph.size(); ++id) {
        const gen::Node& node = pass.graph.node(id);
        const int depth = depthOf(pass.graph, node);
        work.loopDepth = std::max(work.loopDepth, depth);
        double operations = gen::makesNoise(node.op) ? operationsOf(noises[node.imm]) : 1;
        for (int k = 0; k < depth; ++k) operations *= shared::kMaxLoopRounds;
        const bool isOfVoxels = pass.is3D && (node.dependence & gen::kDependsZ) != 0;
        work.operationsPerVoxel += isOfVoxels ? operations : operations * columns;
    }
    return work;
}

// Stamping paints each run of the shape of each column within reach.
double stampOperations(const gen::GeneratorGraph& graph, const gen::PassGraph& pass) {
    constexpr double kSide = world::kChunkSize + 2 * gen::kMaxReadOffset;
    if (graph.shapes == nullptr) return 0;
    std::uint32_t most = 0;
    for (const gen::ShapeRecord& shape : graph.shapes->shapes)
        most = std::max(most, shape.firstRun.back() - shape.firstRun.front());
    return kSide * kSide * most / voxelsOf(graph) * static_cast<double>(pass.stamps.size());
}

// Rings of chunks that must have done the first `passes` passes around one that does.
int ringsOf(const gen::GeneratorGraph& graph, int passes) {
    std::vector<int> rings(static_cast<std::size_t>(passes) + 1, 0);
    for (int pass = 0; pass < passes; ++pass) {
        const int needed = gen::passesNeededAround(graph, pass);
        const int own = needed > 0 ? rings[static_cast<std::size_t>(needed)] + 1 : 0;
        rings[static_cast<std::size_t>(pass) + 1] = std::max(rings[static_cast<std::size_t>(pass)], own);
    }
    return rings.back();
}

}  // namespace

std::string unboundedWork(const gen::GeneratorGraph& graph) {
    const double voxels = voxelsOf(graph);
    double operations = 0;
    const auto add = [&](const gen::PassGraph& pass, const std::vector<gen::NoiseCall>& noises,
                         double columns) -> std::string {
        const PassWork work = workOf(pass, noises, columns);
        operations += work.operationsPerVoxel;
        if (work.loopDepth <= static_cast<int>(kMaxLoopDepth)) return "";
        return fmt::format("pass \"{}\": more than {} nested loops", pass.name, kMaxLoopDepth);
    };
    for (const gen::PassGraph& pass : graph.passes) {
        if (std::string reason = add(pass, graph.noises, world::kBlocksPerLayer / voxels); !reason.empty())
            return reason;
        operations += stampOperations(graph, pass);
    }
    for (const gen::DrainageGraph& map : graph.drainages) {
        const double columns = kColumnsOfRegion * kRegionsOfChunk / voxels;
        if (std::string reason = add(map.heights, map.noises, columns); !reason.empty()) return reason;
    }
    if (operations > kMaxOperationsOfChunk / voxels) {
        return fmt::format(
            "a chunk may take {:.0f} operations per voxel, {:.0f} are allowed: loops count as 1,024 rounds",
            operations, kMaxOperationsOfChunk / voxels);
    }
    const int rings = ringsOf(graph, static_cast<int>(graph.passes.size()));
    if (rings > kMaxRings)
        return fmt::format(
            "chunks need {} rings of neighbors, {} are allowed: passes with offsets read passes that have "
            "offsets themselves",
            rings, kMaxRings);
    const std::ptrdiff_t kept =
        std::count_if(graph.passes.begin(), graph.passes.begin() + gen::sharedPasses(graph),
                      [](const gen::PassGraph& pass) { return pass.is3D; });
    if (kept > kMaxKeptBlocks)
        return fmt::format(
            "the blocks of {} 3D passes are kept for neighbors, {} are allowed: read blocks with "
            "offsets in earlier passes",
            kept, kMaxKeptBlocks);
    return "";
}

}  // namespace terrane::lua
