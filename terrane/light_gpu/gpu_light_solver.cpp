#include "terrane/light_gpu/gpu_light_solver.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <glm/vec2.hpp>
#include <string>

#include "terrane/base/profile.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/debug.h"
#include "terrane/gpu/program.h"
#include "terrane/light_gpu/section_upload_internal.h"
#include "terrane/shared/light_solver.h"

namespace terrane::light_gpu {
namespace {

using light::ChunkLight;
using light::LightArea;

static_assert(std::endian::native == std::endian::little, "words of two levels are read back as they are");

constexpr int kPartChunks = 16;                                // a side
constexpr std::size_t kMaxResult = kPartChunks * kPartChunks;  // chunks
constexpr std::size_t kMaxSolved = (kPartChunks + 2) * (kPartChunks + 2);
constexpr std::size_t kMaxCells = kMaxSolved * shared::kCellsPerChunk;
constexpr std::size_t kLevelBytes = world::kBlocksPerChunk * sizeof(light::LightValue);  // a chunk
constexpr std::size_t kBrickBytes = shared::kBrickWords * sizeof(shared::uint);
constexpr shared::SolverRound kEmptyRound{0, 1, 1, 0};
static_assert(kMaxCells < 65536, "OpenGL has as many work groups along an axis at least");

// Chunks of an area whose light is found together, and those that are solved for it: one more around them
// where there are any, because light travels 15 blocks.
struct Part {
    glm::ivec2 first, size;
    glm::ivec2 firstSolved, sizeSolved;

    std::size_t chunks() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
    std::size_t chunksSolved() const {
        return static_cast<std::size_t>(sizeSolved.x) * static_cast<std::size_t>(sizeSolved.y);
    }
};

Part partAt(const LightArea& area, glm::ivec2 first) {
    const glm::ivec2 end{std::min(first.x + kPartChunks, area.chunksX),
                         std::min(first.y + kPartChunks, area.chunksY)};
    const glm::ivec2 low{std::max(0, first.x - 1), std::max(0, first.y - 1)};
    const glm::ivec2 high{std::min(end.x + 1, area.chunksX), std::min(end.y + 1, area.chunksY)};
    return {first, end - first, low, high - low};
}

light::LightBrick brickOf(const std::byte* words) {
    std::array<light::LightValue, world::kBlocksPerSection> values;
    std::memcpy(values.data(), words, sizeof(values));
    return light::LightBrick::fromValues(values);
}

}  // namespace

struct GpuLightSolver::Impl {
    explicit Impl(const light::LightTable& t) : table(t) {}

    base::Result<void> build(const gpu::ShaderLoader& shaders);
    void upload(const LightArea& area, const Part& part);
    void bind() const;
    void setSources(const Part& part);
    void spreadLight(const Part& part);
    void pack(const Part& part);
    std::vector<ChunkLight> read(const Part& part) const;

    const light::LightTable& table;
    gpu::Program sources, firstCells, spread, packing;
    gpu::Buffer sections, data;                      // of the part at hand
    gpu::Buffer levels, cells, lists, bricks, pool;  // kept
    gpu::Buffer rounds;
    world::PackedSections input;
};

base::Result<void> GpuLightSolver::Impl::build(const gpu::ShaderLoader& shaders) {
    const auto compile = [&](gpu::Program& program, const std::string& name) -> base::Result<void> {
        auto made =
            gpu::Program::compute(shaders, "terrane/light_gpu/" + name + ".comp.glsl", {}, "light " + name);
        if (!made) return tl::unexpected(made.error());
        program = std::move(*made);
        return {};
    };
    for (const auto& [program, name] : {std::pair(&sources, "sources"), std::pair(&firstCells, "first_cells"),
                                        std::pair(&spread, "spread"), std::pair(&packing, "pack")}) {
        if (auto compiled = compile(*program, name); !compiled) return compiled;
    }
    levels = gpu::Buffer(kMaxSolved * kLevelBytes, 0, "light levels");
    cells = gpu::Buffer(kMaxCells * sizeof(shared::uint), 0, "light cells");
    lists = gpu::Buffer(3 * kMaxCells * sizeof(shared::uint), 0, "light work lists");
    rounds = gpu::Buffer((shared::kSolverRounds + 1) * sizeof(shared::SolverRound), GL_DYNAMIC_STORAGE_BIT,
                         "light rounds");
    bricks = gpu::Buffer((1 + kMaxResult * shared::kSectionsPerChunk) * sizeof(shared::uint),
                         GL_DYNAMIC_STORAGE_BIT, "light bricks");
    pool = gpu::Buffer(kMaxResult * kLevelBytes, 0, "light result");
    return {};
}

void GpuLightSolver::Impl::upload(const LightArea& area, const Part& part) {
    input.clear();
    for (int y = 0; y < part.sizeSolved.y; ++y) {
        for (int x = 0; x < part.sizeSolved.x; ++x)
            appendChunk(input, area.chunk(part.firstSolved.x + x, part.firstSolved.y + y), table);
    }
    sections = gpu::Buffer(std::as_bytes(std::span(input.sections)), 0, "light sections");
    data = gpu::Buffer(std::as_bytes(std::span(input.data)), 0, "light section data");
}

void GpuLightSolver::Impl::bind() const {
    sections.bindStorage(shared::kPackedSectionsBinding);
    data.bindStorage(shared::kPackedDataBinding);
    levels.bindStorage(shared::kSolverLevelsBinding);
    cells.bindStorage(shared::kSolverCellsBinding);
    lists.bindStorage(shared::kSolverListsBinding);
    rounds.bindStorage(shared::kSolverRoundsBinding);
    bricks.bindStorage(shared::kSolverBricksBinding);
    pool.bindStorage(shared::kSolverPoolBinding);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, rounds.id());
}

// Emission, daylight down the columns, and which cells the first round looks at.
void GpuLightSolver::Impl::setSources(const Part& part) {
    rounds.uploadVector(0, std::vector(shared::kSolverRounds + 1, kEmptyRound));
    const glm::uvec2 size(part.sizeSolved);
    const auto chunks = static_cast<GLuint>(part.chunksSolved());
    sources.use();
    sources.set(0, size);
    glDispatchCompute(chunks, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    firstCells.use();
    firstCells.set(0, size);
    glDispatchCompute(chunks * shared::kCellsPerChunk / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

// Until no cell is left that could change. Nothing waits between the rounds of a go, and those whose list is
// empty cost a command each; one go is enough for all but winding tunnels.
void GpuLightSolver::Impl::spreadLight(const Part& part) {
    spread.use();
    spread.set(0, glm::uvec2(part.sizeSolved));
    std::vector<shared::SolverRound> go(shared::kSolverRounds + 1, kEmptyRound);
    for (shared::uint first = 0;; first += shared::kSolverRounds) {
        for (shared::uint k = 0; k < shared::kSolverRounds; ++k) {
            spread.set(1, first + k);
            glDispatchComputeIndirect(static_cast<GLintptr>(k * sizeof(shared::SolverRound)));
            glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
        }
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        rounds.download(0, std::as_writable_bytes(std::span(go)));
        if (go.back().groupsX == 0) return;
        go.front() = go.back();
        std::fill(go.begin() + 1, go.end(), kEmptyRound);
        rounds.uploadVector(0, go);
    }
}

void GpuLightSolver::Impl::pack(const Part& part) {
    const std::vector<shared::uint> none = {0};
    bricks.uploadVector(0, none);
    packing.use();
    packing.set(0, glm::uvec2(part.sizeSolved));
    packing.set(1, glm::uvec4(part.first - part.firstSolved, part.size));
    glDispatchCompute(static_cast<GLuint>(part.chunks()), shared::kSectionsPerChunk, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

std::vector<ChunkLight> GpuLightSolver::Impl::read(const Part& part) const {
    std::vector<shared::uint> entries(1 + part.chunks() * shared::kSectionsPerChunk);
    bricks.download(0, std::as_writable_bytes(std::span(entries)));
    std::vector<std::byte> words(entries[0] * kBrickBytes);
    pool.download(0, words);
    std::vector<ChunkLight> lights(part.chunks());
    for (std::size_t k = 1; k < entries.size(); ++k) {
        const bool isUniform = (entries[k] & shared::kBrickUniformBit) != 0;
        const int number = static_cast<int>((k - 1) % shared::kSectionsPerChunk);
        lights[(k - 1) / shared::kSectionsPerChunk].setBrick(
            number, isUniform ? light::LightBrick(static_cast<light::LightValue>(entries[k]))
                              : brickOf(words.data() + entries[k] * kBrickBytes));
    }
    return lights;
}

GpuLightSolver::GpuLightSolver(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GpuLightSolver::GpuLightSolver(GpuLightSolver&&) noexcept = default;
GpuLightSolver& GpuLightSolver::operator=(GpuLightSolver&&) noexcept = default;
GpuLightSolver::~GpuLightSolver() = default;

base::Result<GpuLightSolver> GpuLightSolver::create(const gpu::ShaderLoader& shaders,
                                                    const light::LightTable& table) {
    auto impl = std::make_unique<Impl>(table);
    if (auto built = impl->build(shaders); !built) return tl::unexpected(built.error());
    return GpuLightSolver(std::move(impl));
}

std::vector<ChunkLight> GpuLightSolver::solve(const LightArea& area) {
    TERRANE_ZONE("solve light on the GPU");
    assert(area.chunksX > 0 && area.chunksY > 0 && "an area has chunks");
    const gpu::DebugGroup group("light");
    std::vector<ChunkLight> lights(area.chunks.size());
    for (int y = 0; y < area.chunksY; y += kPartChunks) {
        for (int x = 0; x < area.chunksX; x += kPartChunks) {
            const Part part = partAt(area, {x, y});
            impl_->upload(area, part);
            impl_->bind();
            impl_->setSources(part);
            impl_->spreadLight(part);
            impl_->pack(part);
            std::vector<ChunkLight> found = impl_->read(part);
            for (std::size_t k = 0; k < found.size(); ++k) {
                const auto column = static_cast<int>(k) % part.size.x,
                           row = static_cast<int>(k) / part.size.x;
                lights[static_cast<std::size_t>(x + column + area.chunksX * (y + row))] = std::move(found[k]);
            }
        }
    }
    return lights;
}

}  // namespace terrane::light_gpu
