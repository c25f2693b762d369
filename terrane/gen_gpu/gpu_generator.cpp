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
        if (node.op == gen::Op::Noise && gen::readsDrainage(generator.noises[node.imm].kind)) return true;
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

// A number, or bytes, of slots for the fields and for the blocks of chunks.
struct Slots {
    std::size_t fields, blocks;
};

namespace {

using world::ChunkPos;

constexpr std::size_t kBatchesInFlight = 3;
// The part that is free of z is computed once a work group. More layers would exceed the 65,536 rounds of
// loops after which a software driver may end an invocation.
constexpr int kLayersPerGroup = 64;
constexpr std::size_t kMaxBufferBytes = std::size_t{256} << 20;
constexpr std::size_t kMaxResultBytes = std::size_t{32} << 20;
constexpr std::size_t kSectionBytes = std::size_t{world::kBlocksPerSection} * sizeof(std::uint16_t);

std::size_t chunkBytes(world::Heights heights) {
    return static_cast<std::size_t>(heights.sections()) * kSectionBytes;
}

std::size_t maxBatch(world::Heights heights) {
    return std::clamp<std::size_t>(kMaxResultBytes / chunkBytes(heights), 1, kMaxBatch);
}

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

// The GPU stores the blocks of a section column by column, a chunk stores them layer by layer.
world::Section sectionOf(const std::byte* words) {
    using Value = world::Section::Value;
    Value first;
    std::memcpy(&first, words, sizeof(first));
    const bool isOne = std::memcmp(words, words + sizeof(first), kSectionBytes - sizeof(first)) == 0;
    if (isOne) return world::Section(first);
    constexpr std::size_t kColumns = shared::kBlocksPerLayer;
    std::array<Value, world::kBlocksPerSection> blocks;
    for (std::size_t column = 0; column < kColumns; ++column) {
        std::array<Value, world::kSectionSize> layers;
        std::memcpy(layers.data(), words + column * sizeof(layers), sizeof(layers));
        for (std::size_t z = 0; z < layers.size(); ++z) blocks[z * kColumns + column] = layers[z];
    }
    return world::Section::fromValues(blocks);
}

std::shared_ptr<world::Chunk> chunkOf(const std::byte* words, world::Heights heights) {
    auto chunk = std::make_shared<world::Chunk>(heights);
    for (int number = heights.firstSection(); number < heights.endSection(); ++number, words += kSectionBytes)
        chunk->setSection(number, sectionOf(words));
    return chunk;
}

// Number of the 3D passes before a pass.
int blockNumber(const gen::GeneratorGraph& generator, std::size_t pass) {
    return static_cast<int>(std::count_if(generator.passes.begin(),
                                          generator.passes.begin() + static_cast<long>(pass),
                                          [](const gen::PassGraph& p) { return p.is3D; }));
}

Slots slotBytes(const gen::GeneratorGraph& generator) {
    const std::size_t fieldCount = std::max<std::size_t>(1, generator.fields.size());
    const auto keptBlocks =
        static_cast<std::size_t>(std::max(1, blockNumber(generator, generator.passes.size() - 1)));
    return {fieldCount * shared::kBlocksPerLayer * sizeof(gen::Bits),
            keptBlocks * chunkBytes(generator.heights)};
}

// The first 3D pass whose blocks are kept; past the last pass if none is.
int firstKeptPass(const gen::GeneratorGraph& generator) {
    const auto first = std::find_if(generator.passes.begin(), generator.passes.end(),
                                    [](const gen::PassGraph& pass) { return pass.is3D; });
    const auto number = static_cast<int>(first - generator.passes.begin());
    return number + 1 < static_cast<int>(generator.passes.size()) ? number : number + 1;
}

// As many slots as a shader can address and as kMaxBufferBytes hold.
Slots slotsFor(const gen::GeneratorGraph& generator) {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    const Slots bytes = slotBytes(generator);
    const std::size_t most = std::min(static_cast<std::size_t>(blockBytes), kMaxBufferBytes);
    const bool keepsBlocks = firstKeptPass(generator) < static_cast<int>(generator.passes.size());
    return {std::min(kSlots, most / bytes.fields), keepsBlocks ? std::min(kSlots, most / bytes.blocks) : 1};
}

// Chunks of a plan whose blocks are kept.
std::vector<ChunkPos> chunksWithBlocks(const gen::GeneratorGraph& generator, const PassCounts& needed) {
    const int first = firstKeptPass(generator);
    std::vector<ChunkPos> chunks;
    for (const auto& [pos, count] : needed)
        if (count > first) chunks.push_back(pos);
    return chunks;
}

Slots slotsNeeded(const gen::GeneratorGraph& generator, const PassCounts& needed) {
    return {needed.size(), chunksWithBlocks(generator, needed).size()};
}

}  // namespace

struct GpuGenerator::Impl {
    struct InFlight {
        std::vector<ChunkPos> chunks;
        std::size_t readback;
        gpu::Fence fence;
    };

    Impl(const gen::GeneratorGraph& g, const gpu::ShaderLoader& loader, std::uint64_t seed, Slots counts)
        : generator(g),
          shaders(loader),
          drainages(g.drainages, seed),
          slotCounts(counts),
          fieldSlots(counts.fields),
          blockSlots(counts.blocks) {}

    base::Result<void> build(std::uint64_t seed);
    base::Result<gpu::Program> buildPass(std::size_t pass) const;
    void runPass(std::size_t pass, const std::vector<ChunkPos>& chunks);
    void runPasses(const PassCounts& needed, const std::vector<ChunkPos>& requested);
    void reserveSlots(const PassCounts& needed);
    bool hasRoomFor(const PassCounts& needed) const;
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
    Slots slotCounts;
    SlotCache fieldSlots;  // they count the passes done
    SlotCache blockSlots;  // any pass done means that its blocks are there
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
    const Slots bytes = slotBytes(generator);
    fields = gpu::Buffer(slotCounts.fields * bytes.fields, 0, "generator fields");
    blocks = gpu::Buffer(slotCounts.blocks * bytes.blocks, 0, "generator blocks");
    const std::size_t resultBytes = maxBatch(generator.heights) * chunkBytes(generator.heights);
    result = gpu::Buffer(resultBytes, 0, "generator result");
    for (gpu::ReadbackBuffer& r : readbacks) r = gpu::ReadbackBuffer(resultBytes, "generator read-back");
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
        {"LAYERS_PER_GROUP", std::to_string(kLayersPerGroup)},
        {"BOTTOM", fmt::format("({})", generator.heights.bottom)},
        {"TOP", fmt::format("({})", generator.heights.top)}};
    return gpu::Program::compute(shaders, names[pass], defines, "generator " + generator.passes[pass].name);
}

gpu::Buffer GpuGenerator::Impl::tileJobs(const std::vector<ChunkPos>& chunks) const {
    std::vector<shared::TileJob> jobs;
    for (const ChunkPos pos : chunks) {
        shared::TileJob job{};
        const gen::SampleGrid grid = gen::sampleGrid(pos);
        job.origin = {grid.x, grid.y, 0, grid.step};
        const auto around = gen::chunksAround(pos);
        for (int n = 0; n < 9; ++n) {
            // Read only where the plan asked for it.
            const ChunkPos neighbor = around[static_cast<std::size_t>(n)];
            job.fieldSlots[n / 4][n % 4] = fieldSlots.find(neighbor).value_or(0);
            job.blockSlots[n / 4][n % 4] = blockSlots.find(neighbor).value_or(0);
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
    const int layers = generator.passes[pass].is3D ? generator.heights.layers() : 1;
    const auto layerGroups = static_cast<GLuint>((layers + kLayersPerGroup - 1) / kLayersPerGroup);
    glDispatchCompute(static_cast<GLuint>(chunks.size()), layerGroups, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void GpuGenerator::Impl::runPasses(const PassCounts& needed, const std::vector<ChunkPos>& requested) {
    reserveSlots(needed);
    const int last = static_cast<int>(generator.passes.size()) - 1;
    for (int pass = 0; pass < last; ++pass) {
        std::vector<ChunkPos> running;
        for (const auto& [pos, count] : needed) {
            if (count > pass && fieldSlots.passesDone(pos) <= pass) running.push_back(pos);
        }
        runPass(static_cast<std::size_t>(pass), running);
        for (const ChunkPos pos : running) {
            fieldSlots.setPassesDone(pos, pass + 1);
            if (generator.passes[static_cast<std::size_t>(pass)].is3D)
                blockSlots.setPassesDone(pos, pass + 1);
        }
    }
    runPass(static_cast<std::size_t>(last), requested);
}

// A chunk whose blocks were replaced makes them again.
void GpuGenerator::Impl::reserveSlots(const PassCounts& needed) {
    std::vector<ChunkPos> all;
    for (const auto& [pos, count] : needed) all.push_back(pos);
    fieldSlots.reserve(all);
    const std::vector<ChunkPos> withBlocks = chunksWithBlocks(generator, needed);
    blockSlots.reserve(withBlocks);
    const int firstKept = firstKeptPass(generator);
    for (const ChunkPos pos : withBlocks) {
        if (blockSlots.passesDone(pos) > 0) continue;
        fieldSlots.setPassesDone(pos, std::min(fieldSlots.passesDone(pos), firstKept));
    }
}

bool GpuGenerator::Impl::hasRoomFor(const PassCounts& needed) const {
    const Slots counts = slotsNeeded(generator, needed);
    return counts.fields <= slotCounts.fields && counts.blocks <= slotCounts.blocks;
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
    const Slots ofOne = slotsNeeded(generator, neededPasses(generator, {{0, 0}})),
                slots = slotsFor(generator);
    const bool hasFields = ofOne.fields <= slots.fields;
    if (!hasFields || ofOne.blocks > slots.blocks) {
        return base::fail(
            "generator \"{}\": a chunk needs {} of {} chunks, the GPU has room for {}: let fewer passes read "
            "around each other",
            generator.name, hasFields ? "blocks" : "results", hasFields ? ofOne.blocks : ofOne.fields,
            hasFields ? slots.blocks : slots.fields);
    }
    auto impl = std::make_unique<Impl>(generator, shaders, seed, slots);
    TERRANE_TRY(impl->build(seed));
    return GpuGenerator(std::move(impl));
}

std::size_t GpuGenerator::submit(std::span<const ChunkPos> positions) {
    TERRANE_ZONE("submit generation");
    Impl& impl = *impl_;
    if (impl.inFlight.size() == kBatchesInFlight || positions.empty()) return 0;
    std::vector<ChunkPos> requested(
        positions.begin(),
        positions.begin() + static_cast<long>(std::min(maxBatch(impl.generator.heights), positions.size())));
    for (const ChunkPos pos : requested) gen::requireGenerated(pos, impl.generator.level);
    PassCounts needed = neededPasses(impl.generator, requested);
    while (!impl.hasRoomFor(needed)) {
        assert(requested.size() > 1 && "the slots hold what one chunk needs");
        requested.resize(requested.size() / 2);
        needed = neededPasses(impl.generator, requested);
    }
    impl.runPasses(needed, requested);
    const std::size_t readback = impl.nextReadback;
    impl.nextReadback = (readback + 1) % kBatchesInFlight;
    impl.readbacks[readback].copyFrom(impl.result, requested.size() * chunkBytes(impl.generator.heights));
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
    const world::Heights heights = impl.generator.heights;
    std::vector<gen::GeneratedChunk> batch;
    for (std::size_t k = 0; k < oldest.chunks.size(); ++k)
        batch.push_back({oldest.chunks[k], chunkOf(words + k * chunkBytes(heights), heights)});
    impl.inFlight.pop_front();
    return batch;
}

}  // namespace terrane::gen_gpu
