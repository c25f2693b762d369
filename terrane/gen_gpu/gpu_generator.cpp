#include "terrane/gen_gpu/gpu_generator.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <deque>
#include <string>

#include "terrane/base/profile.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/glsl_emitter.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/noise/sample_grid.h"
#include "terrane/gen_gpu/pass_plan.h"
#include "terrane/gpu/buffer.h"
#include "terrane/gpu/debug.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/shared/generation.h"

namespace terrane::gen_gpu {

bool readsDrainage(const gen::GeneratorGraph& generator, const gen::PassGraph& pass) {
    for (gen::NodeId id = 0; id < pass.graph.size(); ++id) {
        const gen::Node& node = pass.graph.node(id);
        if (node.op == gen::Op::Noise && generator.noises[node.imm].kind == gen::NoiseKind::Drainage)
            return true;
    }
    return false;
}

DrainageBuffers uploadDrainage(gen::DrainageMaps& maps, std::size_t mapCount,
                               std::span<const world::ChunkPos> chunks) {
    std::vector<shared::DrainageList> lists;
    std::vector<shared::vec4> data(1);  // buffers are not empty
    gen::DrainageTile tile;
    for (const world::ChunkPos pos : chunks) {
        for (std::size_t map = 0; map < mapCount; ++map) {
            maps.prepare(tile, static_cast<std::uint32_t>(map), gen::sampleGrid(pos));
            lists.push_back({static_cast<shared::uint>(data.size()),
                             static_cast<shared::uint>(tile.segments.size()),
                             static_cast<shared::uint>(tile.lakes.size()), 0u});
            for (const shared::RiverSegment& s : tile.segments)
                data.insert(data.end(), {s.line, s.course, s.flow});
            data.insert(data.end(), tile.lakes.begin(), tile.lakes.end());
        }
    }
    return {gpu::Buffer(std::as_bytes(std::span(lists)), 0, "drainage lists"),
            gpu::Buffer(std::as_bytes(std::span(data)), 0, "drainage data")};
}

namespace {

using world::ChunkPos;

constexpr std::size_t kBatchesInFlight = 3;
constexpr int kLayersPerGroup =
    64;  // four work groups a chunk: the part that is free of z is computed four times
constexpr std::size_t kMaxBufferBytes = std::size_t{256} << 20;
constexpr std::size_t kChunkBytes = std::size_t{world::kBlocksPerChunk} * sizeof(std::uint16_t);

gpu::Buffer wordBuffer(const std::vector<std::uint32_t>& seeds, std::string_view label) {
    // Buffers are not empty, generators without noise or random numbers are possible.
    const std::vector<std::uint32_t> values = seeds.empty() ? std::vector<std::uint32_t>{0} : seeds;
    return gpu::Buffer(std::as_bytes(std::span(values)), 0, label);
}

std::string shaderName(std::size_t pass) {
    return fmt::format("generated/pass{}.comp.glsl", pass);
}

std::string includeOf(const char* name) {
    return fmt::format("#include \"terrane/gen_gpu/{}.glsl\"\n", name);
}

std::string shaderText(const gen::GeneratorGraph& generator, std::size_t pass) {
    const gen::PassGraph& graph = generator.passes[pass];
    std::string text;
    for (const char* name : {"tile", "voronoi", "simplex", "stripes"}) text += includeOf(name);
    if (!graph.stamps.empty()) text += includeOf("stamps");
    if (readsDrainage(generator, graph)) text += includeOf("drainage");
    return text + "\n" + gen::emitGlsl(generator, pass);
}

// The GPU stores blocks column by column, a chunk stores them layer by layer.
std::shared_ptr<world::Chunk> chunkOf(const std::byte* words) {
    thread_local std::array<world::Section::Value, world::kBlocksPerChunk> blocks;
    constexpr std::size_t kColumns = shared::kBlocksPerLayer;
    for (std::size_t column = 0; column < kColumns; ++column) {
        std::array<std::uint16_t, world::kChunkHeight> layers;
        std::memcpy(layers.data(), words + column * sizeof(layers), sizeof(layers));
        for (std::size_t z = 0; z < layers.size(); ++z) blocks[z * kColumns + column] = layers[z];
    }
    auto chunk = std::make_shared<world::Chunk>();
    for (int s = 0; s < world::kSectionsPerChunk; ++s) {
        const auto first = static_cast<std::size_t>(s) * world::kBlocksPerSection;
        chunk->setSection(s, world::Section::fromValues(
                                 std::span(blocks).subspan(first).first<world::kBlocksPerSection>()));
    }
    return chunk;
}

// Number of the 3D passes before a pass.
int blockNumber(const gen::GeneratorGraph& generator, std::size_t pass) {
    return static_cast<int>(std::count_if(generator.passes.begin(),
                                          generator.passes.begin() + static_cast<long>(pass),
                                          [](const gen::PassGraph& p) { return p.is3D; }));
}

struct SlotBytes {
    std::size_t fields, blocks;
};

SlotBytes slotBytes(const gen::GeneratorGraph& generator) {
    const std::size_t fieldCount = std::max<std::size_t>(1, generator.fields.size());
    const auto keptBlocks =
        static_cast<std::size_t>(std::max(1, blockNumber(generator, generator.passes.size() - 1)));
    return {fieldCount * shared::kBlocksPerLayer * sizeof(gen::Bits), keptBlocks * kChunkBytes};
}

// As many slots as a shader can address in both buffers, and as kMaxBufferBytes hold.
std::size_t slotsFor(const gen::GeneratorGraph& generator) {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    const SlotBytes bytes = slotBytes(generator);
    const std::size_t most = std::min(static_cast<std::size_t>(blockBytes), kMaxBufferBytes);
    return std::min(kSlots, most / std::max(bytes.fields, bytes.blocks));
}

}  // namespace

struct GpuGenerator::Impl {
    struct InFlight {
        std::vector<ChunkPos> chunks;
        std::size_t readback;
        gpu::Fence fence;
    };

    Impl(const gen::GeneratorGraph& g, const gpu::ShaderLoader& loader, std::uint64_t seed, std::size_t count)
        : generator(g), shaders(loader), drainages(g.drainages, seed), slotCount(count), slots(count) {}

    base::Result<void> build(std::uint64_t seed);
    base::Result<gpu::Program> buildPass(std::size_t pass) const;
    void runPass(std::size_t pass, const std::vector<ChunkPos>& chunks);
    void runPasses(const PassCounts& needed, const std::vector<ChunkPos>& requested);
    gpu::Buffer tileJobs(const std::vector<ChunkPos>& chunks) const;

    gen::GeneratorGraph generator;
    std::vector<std::string> names, texts;  // of the passes' shaders; the loader refers to them
    std::vector<base::EmbeddedFile> files;
    gpu::ShaderLoader shaders;
    std::vector<gpu::Program> programs;
    gen::DrainageMaps drainages;
    gpu::Buffer fields, blocks, result, noiseSeeds, hashSeeds, shapes;
    std::array<gpu::ReadbackBuffer, kBatchesInFlight> readbacks;
    std::deque<InFlight> inFlight;
    std::size_t nextReadback = 0;
    std::size_t slotCount;
    SlotCache slots;
};

base::Result<void> GpuGenerator::Impl::build(std::uint64_t seed) {
    for (std::size_t pass = 0; pass < generator.passes.size(); ++pass)
        texts.push_back(shaderText(generator, pass));
    for (std::size_t pass = 0; pass < texts.size(); ++pass) names.push_back(shaderName(pass));
    for (std::size_t pass = 0; pass < texts.size(); ++pass) files.push_back({names[pass], texts[pass]});
    shaders.addFiles(files);
    for (std::size_t pass = 0; pass < texts.size(); ++pass) {
        auto program = TERRANE_TRY(buildPass(pass));
        programs.push_back(std::move(program));
    }
    const gen::Seeds seeds = gen::makeSeeds(generator, seed);
    noiseSeeds = wordBuffer(seeds.noises, "noise seeds");
    hashSeeds = wordBuffer(seeds.hashes, "hash seeds");
    if (generator.shapes) shapes = wordBuffer(gen::shapeWords(*generator.shapes), "generator shapes");
    const SlotBytes bytes = slotBytes(generator);
    fields = gpu::Buffer(slotCount * bytes.fields, 0, "generator fields");
    blocks = gpu::Buffer(slotCount * bytes.blocks, 0, "generator blocks");
    result = gpu::Buffer(kMaxBatch * kChunkBytes, 0, "generator result");
    for (gpu::ReadbackBuffer& r : readbacks)
        r = gpu::ReadbackBuffer(kMaxBatch * kChunkBytes, "generator read-back");
    return {};
}

base::Result<gpu::Program> GpuGenerator::Impl::buildPass(std::size_t pass) const {
    const int before = blockNumber(generator, pass);
    const bool isLast = pass + 1 == generator.passes.size();
    const gpu::ShaderDefines defines = {
        {"FIELD_COUNT", fmt::format("{}u", std::max<std::size_t>(1, generator.fields.size()))},
        {"BLOCK_PASS_COUNT",
         fmt::format("{}u", std::max(1, blockNumber(generator, generator.passes.size() - 1)))},
        {"SOURCE_BLOCKS", fmt::format("{}u", std::max(0, before - 1))},
        {"TARGET_BLOCKS", isLast ? "-1" : std::to_string(before)},
        {"LAYERS_PER_GROUP", std::to_string(kLayersPerGroup)}};
    return gpu::Program::compute(shaders, names[pass], defines, "generator " + generator.passes[pass].name);
}

gpu::Buffer GpuGenerator::Impl::tileJobs(const std::vector<ChunkPos>& chunks) const {
    std::vector<shared::TileJob> jobs;
    for (const ChunkPos pos : chunks) {
        shared::TileJob job{};
        const gen::SampleGrid grid = gen::sampleGrid(pos);
        job.origin = {grid.x, grid.y, static_cast<int>(slots.slot(pos)), grid.step};
        const auto around = gen::chunksAround(pos);
        for (int n = 0; n < 9; ++n) {
            const auto slot = slots.find(around[static_cast<std::size_t>(n)]);
            job.neighbors[n / 4][n % 4] = slot.value_or(0);  // read only where the plan asked for it
        }
        jobs.push_back(job);
    }
    return gpu::Buffer(std::as_bytes(std::span(jobs)), 0, "tile jobs");
}

void GpuGenerator::Impl::runPass(std::size_t pass, const std::vector<ChunkPos>& chunks) {
    if (chunks.empty()) return;
    const gpu::DebugGroup group("generator " + generator.passes[pass].name);
    const gpu::Buffer jobs = tileJobs(chunks);
    jobs.bindStorage(shared::kTileJobsBinding);
    fields.bindStorage(shared::kFieldsBinding);
    blocks.bindStorage(shared::kBlocksBinding);
    result.bindStorage(shared::kResultBinding);
    noiseSeeds.bindStorage(shared::kNoiseSeedsBinding);
    hashSeeds.bindStorage(shared::kHashSeedsBinding);
    if (!generator.passes[pass].stamps.empty()) shapes.bindStorage(shared::kShapesBinding);
    DrainageBuffers drainage;  // until the dispatch has begun
    if (readsDrainage(generator, generator.passes[pass])) {
        drainage = uploadDrainage(drainages, generator.drainages.size(), chunks);
        drainage.lists.bindStorage(shared::kDrainageListsBinding);
        drainage.data.bindStorage(shared::kDrainageDataBinding);
    }
    programs[pass].use();
    const GLuint layerGroups = generator.passes[pass].is3D ? world::kChunkHeight / kLayersPerGroup : 1;
    glDispatchCompute(static_cast<GLuint>(chunks.size()), layerGroups, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuGenerator::Impl::runPasses(const PassCounts& needed, const std::vector<ChunkPos>& requested) {
    std::vector<ChunkPos> all;
    for (const auto& [pos, count] : needed) all.push_back(pos);
    slots.reserve(all);
    const int last = static_cast<int>(generator.passes.size()) - 1;
    for (int pass = 0; pass < last; ++pass) {
        std::vector<ChunkPos> running;
        for (const ChunkPos pos : all) {
            if (needed.at(pos) > pass && slots.passesDone(pos) <= pass) running.push_back(pos);
        }
        runPass(static_cast<std::size_t>(pass), running);
        for (const ChunkPos pos : running) slots.setPassesDone(pos, pass + 1);
    }
    runPass(static_cast<std::size_t>(last), requested);
}

int GpuGenerator::level() const {
    return impl_->generator.level;
}

GpuGenerator::GpuGenerator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GpuGenerator::GpuGenerator(GpuGenerator&&) noexcept = default;
GpuGenerator& GpuGenerator::operator=(GpuGenerator&&) noexcept = default;
GpuGenerator::~GpuGenerator() = default;

base::Result<GpuGenerator> GpuGenerator::create(const gpu::ShaderLoader& shaders,
                                                const gen::GeneratorGraph& generator, std::uint64_t seed) {
    // submit() would take no chunk of it, and its caller would never end.
    const std::size_t slotsOfOne = neededPasses(generator, {{0, 0}}).size(), slots = slotsFor(generator);
    if (slotsOfOne > slots) {
        return base::fail(
            "generator \"{}\": a chunk needs results of {} chunks, the GPU has room for {}: let fewer passes "
            "read around each other",
            generator.name, slotsOfOne, slots);
    }
    auto impl = std::make_unique<Impl>(generator, shaders, seed, slots);
    TERRANE_TRY(impl->build(seed));
    return GpuGenerator(std::move(impl));
}

std::size_t GpuGenerator::submit(std::span<const ChunkPos> positions) {
    TERRANE_ZONE("submit generation");
    Impl& impl = *impl_;
    if (impl.inFlight.size() == kBatchesInFlight || positions.empty()) return 0;
    std::vector<ChunkPos> requested(positions.begin(),
                                    positions.begin() + std::min<long>(kMaxBatch, std::ssize(positions)));
    for (const ChunkPos pos : requested) gen::requireGenerated(pos, impl.generator.level);
    PassCounts needed = neededPasses(impl.generator, requested);
    while (needed.size() > impl.slotCount) {
        assert(requested.size() > 1 && "the slots hold what one chunk needs");
        requested.resize(requested.size() / 2);
        needed = neededPasses(impl.generator, requested);
    }
    impl.runPasses(needed, requested);
    const std::size_t readback = impl.nextReadback;
    impl.nextReadback = (readback + 1) % kBatchesInFlight;
    impl.readbacks[readback].copyFrom(impl.result, requested.size() * kChunkBytes);
    impl.inFlight.push_back({requested, readback, gpu::Fence::insert()});
    return requested.size();
}

std::vector<gen::GeneratedChunk> GpuGenerator::take(bool wait) {
    Impl& impl = *impl_;
    if (impl.inFlight.empty()) return {};
    const Impl::InFlight& oldest = impl.inFlight.front();
    if (wait) oldest.fence.wait();
    if (!oldest.fence.passed()) return {};
    TERRANE_ZONE("take generated chunks");
    const std::byte* words = impl.readbacks[oldest.readback].data().data();
    std::vector<gen::GeneratedChunk> batch;
    for (std::size_t k = 0; k < oldest.chunks.size(); ++k)
        batch.push_back({oldest.chunks[k], chunkOf(words + k * kChunkBytes)});
    impl.inFlight.pop_front();
    return batch;
}

}  // namespace terrane::gen_gpu
