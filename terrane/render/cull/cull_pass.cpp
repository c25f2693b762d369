#include "terrane/render/cull/cull_pass.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

#include "terrane/gpu/debug.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

base::Result<QuadCull> QuadCull::create(const gpu::ShaderLoader& shaders) {
    QuadCull cull;
    auto program = TERRANE_TRY(
        gpu::Program::compute(shaders, "terrane/render/cull/quad_cull.comp.glsl", {}, "cull quads"));
    cull.program_ = std::move(program);
    return cull;
}

void QuadCull::begin(std::uint32_t meshSections) {
    const std::size_t needed = sizeof(shared::TestedMeshSections) + meshSections * sizeof(shared::uint);
    if (const std::size_t bytes = grownBytes(list_, needed); bytes > 0)
        list_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "mesh sections to test");
    const shared::TestedMeshSections none{0, 1, 1, 0};
    list_.upload(0, std::as_bytes(std::span(&none, 1)));
    list_.bindStorage(shared::kTestedMeshSectionsBinding);
}

void QuadCull::run(const QuadStore& quads, const QuadResources& resources) const {
    const gpu::DebugGroup group("cull quads");
    resources.bindTables();
    program_.use();
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_.id());
    const std::vector<const gpu::Buffer*> arenas = quads.buffers().buffers;
    for (std::size_t arena = 0; arena < arenas.size(); ++arena) {
        arenas[arena]->bindStorage(shared::kQuadsBinding);
        program_.set(shared::kArenaLocation, static_cast<GLuint>(arena));
        glDispatchComputeIndirect(0);
    }
    // The vertex shader reads the quads as texels; uploads and copies may follow.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

namespace {

using TwoCounts = std::array<shared::DrawCounts, 2>;  // of the early and the late pass, of one arena

gpu::Buffer gpuOnly(std::size_t bytes, std::string_view label) {
    return gpu::Buffer(bytes, 0, label);
}

static_assert(static_cast<shared::uint>(CullPhase::Early) == shared::kCullEarly &&
              static_cast<shared::uint>(CullPhase::Late) == shared::kCullLate);

shared::CullFrame frameOf(CullPhase phase, const CullInput& input, std::uint32_t meshSections) {
    shared::CullFrame frame{};
    std::ranges::copy(input.camera, frame.cameraPlanes);
    frame.cameraPosition = glm::vec4(input.cameraPosition, 0);
    frame.view = input.view();
    frame.cameraChunk = {input.cameraChunk.x, input.cameraChunk.y};
    frame.meshSectionCount = meshSections;
    frame.phase = static_cast<shared::uint>(phase);
    return frame;
}

void add(shared::DrawCounts& sum, const shared::DrawCounts& counts) {
    for (std::uint32_t list = 0; list < shared::kDrawLists; ++list) {
        sum.commands[list] += counts.commands[list];
        sum.quads[list] += counts.quads[list];
    }
    sum.meshSections += counts.meshSections;
}

}  // namespace

base::Result<CullPass> CullPass::create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device,
                                        const DrawLimits& limits) {
    CullPass pass;
    pass.limits_ = limits.ofDriver();
    auto cull = TERRANE_TRY(gpu::Program::compute(shaders, "terrane/render/cull/cull.comp.glsl", {}, "cull"));
    auto compact =
        TERRANE_TRY(gpu::Program::compute(shaders, "terrane/render/cull/compact.comp.glsl", {}, "compact"));
    auto quadCull = TERRANE_TRY(QuadCull::create(shaders));
    auto quadList = TERRANE_TRY(QuadList::create(shaders, limits));
    pass.quadCull_ = std::move(quadCull);
    pass.quadList_ = std::move(quadList);
    pass.cull_ = std::move(cull);
    pass.compact_ = std::move(compact);
    pass.hasIndirectCount_ = device.indirectCount;
    const std::array<TwoCounts, shared::kMaxArenas> none{};  // 3.3 KB
    pass.countBuffer_ = gpu::Buffer(std::as_bytes(std::span(none)), GL_DYNAMIC_STORAGE_BIT, "draw counts");
    for (Readback& readback : pass.readbacks_) {
        readback.buffer = gpu::ReadbackBuffer(sizeof(none), "draw counts");
    }
    return pass;
}

// Room for all faces of each list's draw bucket, so that no list can overflow.
std::size_t CullPass::commandBytes(const MeshSectionTable& meshSections, std::size_t bytesEach) const {
    std::size_t sum = 0;
    for (const BucketCommands& buckets : meshSections.maxCommands())
        for (const std::uint32_t commands : buckets) sum += commands;
    return std::clamp<std::size_t>(sum, 1, limits_.commands) * bytesEach;
}

// QuadStore refuses mesh sections whose commands would pass the limit. Beyond it, lists are cut.
void CullPass::reserve(const MeshSectionTable& meshSections) {
    std::uint32_t sum = 0;
    lists_.resize(meshSections.maxCommands().size());
    assert(lists_.size() <= shared::kMaxArenas && "the store has no more arenas");
    for (std::size_t arena = 0; arena < lists_.size(); ++arena) {
        for (std::uint32_t list = 0; list < shared::kDrawLists; ++list) {
            const std::uint32_t room = limits_.commands - sum;
            lists_[arena][list] = {sum, std::min(meshSections.maxCommands()[arena][list], room)};
            sum += lists_[arena][list].max;
        }
    }
    commandsEnd_ = sum;
    const auto grow = [](gpu::Buffer& buffer, std::size_t neededBytes, std::string_view label) {
        const std::size_t bytes = grownBytes(buffer, neededBytes);
        if (bytes > 0) buffer = gpuOnly(bytes, label);
        return bytes > 0;
    };
    grow(commands_, commandBytes(meshSections, sizeof(shared::DrawCommand)), "draw commands");
    grow(records_, commandBytes(meshSections, sizeof(shared::DrawRecord)), "draw records");
    grow(visible_, meshSections.count() * sizeof(std::uint32_t), "visible mesh sections");
    if (!grow(visibleLastFrame_, meshSections.slots() * sizeof(std::uint32_t),
              "mesh sections visible last frame"))
        return;
    const GLuint zero = 0;
    glClearNamedBufferData(visibleLastFrame_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

std::size_t CullPass::gpuBytes(const MeshSectionTable& meshSections, DrawMethod method) const {
    const std::size_t now = commands_.sizeBytes() + records_.sizeBytes() + visible_.sizeBytes() +
                            visibleLastFrame_.sizeBytes() + countBuffer_.sizeBytes() + quadCull_.gpuBytes() +
                            quadList_.gpuBytes() + cpu_.gpuBytes();
    if (method == DrawMethod::Loop) return now;
    return now + grownBytes(commands_, commandBytes(meshSections, sizeof(shared::DrawCommand))) +
           grownBytes(records_, commandBytes(meshSections, sizeof(shared::DrawRecord))) +
           grownBytes(visible_, meshSections.count() * sizeof(std::uint32_t)) +
           grownBytes(visibleLastFrame_, meshSections.slots() * sizeof(std::uint32_t));
}

// Mesh sections not tested before count as hidden: the late pass draws them.
void CullPass::dispatch(const CullInput& input, const MeshSectionTable& meshSections, gpu::MappedRing& ring) {
    shared::CullFrame frame = frameOf(phase_, input, meshSections.count());
    for (std::uint32_t number = 0; number < shared::kMaxArenas * shared::kDrawLists; ++number) {
        const bool isUsed = number < lists_.size() * shared::kDrawLists;
        frame.firstCommand[number / 4][static_cast<int>(number % 4)] =
            isUsed ? lists_[number / shared::kDrawLists][number % shared::kDrawLists].first : commandsEnd_;
    }
    frame.commandsEnd = commandsEnd_;
    frame.maxTestGroups = limits_.testGroups;
    frame.arenaQuads = meshSections.arenaQuads();
    ring.writeUniform(shared::kCullBinding, frame);
    if (input.hiZ) gpu::TextureSet().add(shared::kHiZUnit, input.hiZ->id()).bind();
    meshSections.bindRecords();
    meshSections.bindOrder();
    visible_.bindStorage(shared::kVisibleBinding);
    visibleLastFrame_.bindStorage(shared::kVisibleLastFrameBinding);
    commands_.bindStorage(shared::kCommandsBinding);
    countBuffer_.bindStorage(shared::kCountsBinding);
    quadCull_.begin(meshSections.count());
    cull_.use();
    glDispatchCompute((meshSections.count() + shared::kCullThreads - 1) / shared::kCullThreads, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    if (phase_ == CullPhase::Late) quadCull_.run(*input.quads, *input.resources);
    records_.bindStorage(shared::kDrawRecordsBinding);
    compact_.use();
    glDispatchCompute(shared::kDrawLists, static_cast<GLuint>(lists_.size()), 1);
    if (phase_ != CullPhase::All)
        quadList_.run(*input.quads, phase_ == CullPhase::Early ? shared::kQuadSeen : shared::kQuadNew);
    // The late pass overwrites what the early one read.
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void CullPass::run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
                   gpu::MappedRing& ring) {
    const gpu::DebugGroup group("cull");
    phase_ = phase;
    method_ = input.method;
    if (method_ == DrawMethod::Loop) {
        cpu_.run(phase, input, meshSections, limits_);
        return;
    }
    const GLuint zero = 0;
    if (phase != CullPhase::Late) {
        reserve(meshSections);
        glClearNamedBufferData(countBuffer_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    }
    if (meshSections.count() == 0) return;
    if (!hasIndirectCount_) {
        glClearNamedBufferData(commands_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    }
    dispatch(input, meshSections, ring);
}

std::size_t CullPass::countsOffset(std::size_t arena) const {
    return (2 * arena + (phase_ == CullPhase::Late ? 1 : 0)) * sizeof(shared::DrawCounts);
}

void CullPass::drawList(shared::uint list, std::size_t arena) const {
    if (method_ == DrawMethod::Loop) {
        cpu_.bindListed();
        drawCommands(method_, {.onCpu = cpu_.commands(arena, list)});
        return;
    }
    quadList_.bind();
    drawCommands(method_, {.commands = &commands_,
                           .first = lists_[arena][list].first,
                           .count = lists_[arena][list].max,
                           .counts = hasIndirectCount_ ? &countBuffer_ : nullptr,
                           .countOffsetBytes = countsOffset(arena) + list * sizeof(shared::uint)});
}

bool CullPass::isEmpty(shared::uint list, std::size_t arena) const {
    return method_ == DrawMethod::Loop ? cpu_.commands(arena, list).empty() : lists_[arena][list].max == 0;
}

void CullPass::drawBuckets(gpu::Pipeline& pipeline, const gpu::PipelineState& state, const QuadStore& quads,
                           mesh::AlphaClass alphaClass) const {
    for (const bool isTwoSided : {false, true}) {
        gpu::PipelineState bucketState = state;
        bucketState.cullsBackFaces = !isTwoSided;
        pipeline.set(bucketState);
        const auto list = static_cast<shared::uint>(mesh::drawBucket(alphaClass, isTwoSided));
        for (std::size_t arena = 0; arena < arenaCount(); ++arena) {
            if (isEmpty(list, arena)) continue;
            quads.bindTexels(arena);
            drawList(list, arena);
        }
    }
}

// Skipped if the GPU is as many frames behind as there are buffers.
void CullPass::endFrame() {
    if (method_ == DrawMethod::Loop) {
        cpu_.endFrame();
        return;
    }
    counts();
    Readback& readback = readbacks_[nextReadback_];
    if (readback.isPending) return;
    readback.arenas = lists_.size();
    readback.buffer.copyFrom(countBuffer_, readback.arenas * sizeof(TwoCounts));
    readback.fence = gpu::Fence::insert();
    readback.isPending = true;
    nextReadback_ = (nextReadback_ + 1) % kReadbacks;
}

const shared::DrawCounts& CullPass::counts() {
    if (method_ == DrawMethod::Loop) return cpu_.counts();
    for (std::size_t k = 0; k < kReadbacks; ++k) {
        Readback& readback = readbacks_[(nextReadback_ + k) % kReadbacks];
        if (!readback.isPending || !readback.fence.passed()) continue;
        std::array<TwoCounts, shared::kMaxArenas> arenas;
        std::memcpy(arenas.data(), readback.buffer.data().data(), readback.arenas * sizeof(TwoCounts));
        counts_ = {};
        for (const TwoCounts& both : std::span(arenas).first(readback.arenas))
            for (const shared::DrawCounts& counts : both) add(counts_, counts);
        readback.isPending = false;
    }
    return counts_;
}

std::vector<CullPass::Draw> CullPass::readDraws(shared::uint list, std::size_t arena) const {
    if (method_ == DrawMethod::Loop) {
        std::vector<Draw> draws;
        for (const shared::DrawCommand& command : cpu_.commands(arena, list))
            draws.push_back({command, cpu_.recordOf(command)});
        return draws;
    }
    shared::DrawCounts counts{};
    countBuffer_.download(countsOffset(arena), std::as_writable_bytes(std::span(&counts, 1)));
    std::vector<Draw> draws(counts.commands[list]);
    assert(draws.size() <= lists_[arena][list].max && "each list has room for all commands");
    for (std::size_t k = 0; k < draws.size(); ++k) {
        const std::size_t number = lists_[arena][list].first + k;
        commands_.download(number * sizeof(shared::DrawCommand),
                           std::as_writable_bytes(std::span(&draws[k].command, 1)));
        records_.download(number * sizeof(shared::DrawRecord),
                          std::as_writable_bytes(std::span(&draws[k].record, 1)));
    }
    return draws;
}

// Culling within a frame: everything in view at once, or with occlusion culling what was visible in the frame
// before, then what its depth does not hide.
MaybePass makeCull(FrameBuilder& build) {
    if (build.options().surfaces == SurfaceMethod::Rays) return std::nullopt;
    return Pass{.record =
                    [](FrameContext& context) {
                        const CullPhase phase = context.cullsOccluded() ? CullPhase::Early : CullPhase::All;
                        context.cull.run(phase, context.culling, context.meshSections, context.ring);
                    },
                .drawnIn = DrawnIn::EveryView};
}

MaybePass makeLateCull(FrameBuilder& build) {
    if (!build.options().occlusionCulling) return std::nullopt;
    return Pass{.reads = {build.frame.targets.hiZ},
                .record =
                    [](FrameContext& context) {
                        context.cull.run(CullPhase::Late, context.culling, context.meshSections,
                                         context.ring);
                    },
                .isNeeded = [](FrameContext& context) { return context.cullsOccluded(); },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
