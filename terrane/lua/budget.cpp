#include "terrane/lua/budget_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "terrane/base/machine.h"
#include "terrane/gen/noise/noise.h"
#include "terrane/lua/lua_internal.h"
#include "terrane/world/coords.h"

namespace terrane::lua {

namespace {

constexpr std::int64_t kStepsBetweenClocks = 2'000;  // some 10 µs
constexpr std::int64_t kStepsOfBlock = 10;           // a call of malloc
constexpr std::int64_t kBytesOfStep = 64;            // written in the time of an instruction
// Lua collects all garbage where memory is refused, and asks again. 64 MiB count as all steps of a script, so
// that steps and not the clock end one that lives at its limit.
constexpr std::int64_t kCollectedBytesOfStep = 16;
constexpr std::size_t kTextHeadBytes = 32;  // Lua's header of a text, 24 bytes, and the zero behind it

// Sanitizers make everything slower, which is not the script's fault.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSlowness = 10;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr int kSlowness = 10;
#else
constexpr int kSlowness = 1;
#endif
#else
constexpr int kSlowness = 1;
#endif

// The line of the innermost function of the script; 0 while none runs.
int currentLine(lua_State* L) {
    lua_Debug frame;
    if (L == nullptr) return 0;
    for (int level = 0; level < 4 && lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "l", &frame);
        if (frame.currentline > 0) return frame.currentline;
    }
    return 0;
}

}  // namespace

Budget::Budget(const Limits& limits) : limits_(limits), start_(base::threadTime()) {
    limits_.time *= kSlowness;
}

bool Budget::charge(std::int64_t steps) {
    return spend(steps, kStepsBetweenClocks);
}

bool Budget::chargeAndReadClock(std::int64_t steps) {
    return spend(steps, 0);
}

bool Budget::spend(std::int64_t steps, std::int64_t stepsBetweenClocks) {
    steps_ += steps;
    if (spent_ != Spent::Nothing) return false;
    if (steps_ > limits_.steps) {
        spent_ = Spent::Steps;
    } else if (steps_ >= stepsAtClock_ + stepsBetweenClocks) {
        stepsAtClock_ = steps_;
        if (base::threadTime() - start_ > limits_.time) spent_ = Spent::Time;
    }
    if (spent_ == Spent::Nothing) return true;
    line_ = currentLine(state_);
    return false;
}

void Budget::pauseClock() {
    pausedAt_ = base::threadTime();
}

void Budget::resumeClock() {
    start_ += base::threadTime() - pausedAt_;
}

bool Budget::allows(std::size_t oldBytes, std::size_t newBytes, std::size_t mostBytes) {
    const auto written = static_cast<std::int64_t>(std::min(newBytes, limits_.memoryBytes));
    if (!charge(kStepsOfBlock + written / kBytesOfStep)) return false;
    if (newBytes <= mostBytes && bytes_ - oldBytes + newBytes <= limits_.memoryBytes) return true;
    line_ = currentLine(state_);
    steps_ += static_cast<std::int64_t>(bytes_) / kCollectedBytesOfStep;
    if (steps_ > limits_.steps) spent_ = Spent::Memory;
    return false;
}

void* Budget::allocate(void* budget, void* block, std::size_t oldBytes, std::size_t newBytes) {
    auto& self = *static_cast<Budget*>(budget);
    std::size_t mostBytes = self.limits_.blockBytes;
    if (block == nullptr) {
        // Lua passes the kind of value that a new block is for.
        if (oldBytes == LUA_TSTRING) mostBytes = self.limits_.textBytes + kTextHeadBytes;
        oldBytes = 0;
    }
    if (newBytes == 0) {
        std::free(block);
        self.bytes_ -= oldBytes;
        return nullptr;
    }
    // Lua relies on it that blocks can always become smaller.
    if (newBytes > oldBytes && !self.allows(oldBytes, newBytes, mostBytes)) return nullptr;
    void* moved = std::realloc(block, newBytes);
    if (moved == nullptr) return nullptr;
    self.bytes_ = self.bytes_ - oldBytes + newBytes;
    self.peakBytes_ = std::max(self.peakBytes_, self.bytes_);
    return moved;
}

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
