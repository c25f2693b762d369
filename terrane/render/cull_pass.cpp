#include "terrane/render/cull_pass.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

using TwoCounts = std::array<shared::DrawCounts, 2>;  // of the early and the late pass

gpu::Buffer gpuOnly(std::size_t bytes, std::string_view label) {
    return gpu::Buffer(bytes, 0, label);
}

static_assert(static_cast<shared::uint>(CullPhase::Early) == shared::kCullEarly &&
              static_cast<shared::uint>(CullPhase::Late) == shared::kCullLate);

// Without a shadow map: no point is inside of such a plane.
constexpr glm::vec4 kNothing(0, 0, 0, -1);
constexpr Frustum kEmptyVolume{kNothing, kNothing, kNothing, kNothing, kNothing};

shared::CullFrame frameOf(CullPhase phase, const CullInput& input, std::uint32_t meshSections) {
    shared::CullFrame frame{};
    std::ranges::copy(input.camera, frame.cameraPlanes);
    std::ranges::copy(input.shadow.value_or(kEmptyVolume), frame.shadowPlanes);
    frame.cameraPosition = glm::vec4(input.cameraPosition, 0);
    frame.lightDirection = glm::vec4(input.lightDirection, 0);
    frame.viewProjection = input.viewProjection;
    frame.cameraChunk = {input.cameraChunk.x, input.cameraChunk.y};
    frame.viewportSize = input.size;
    frame.nearPlane = kNearPlane;
    frame.hiZLevels = input.hiZ ? input.hiZ->levels() : 0;
    frame.meshSectionCount = meshSections;
    frame.phase = static_cast<shared::uint>(phase);
    return frame;
}

shared::DrawCounts sumOf(const TwoCounts& both) {
    shared::DrawCounts sum = both[0];
    for (std::uint32_t list = 0; list < shared::kDrawLists; ++list) {
        sum.commands[list] += both[1].commands[list];
        sum.quads[list] += both[1].quads[list];
    }
    sum.meshSections += both[1].meshSections;
    return sum;
}

}  // namespace

base::Result<CullPass> CullPass::create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device) {
    CullPass pass;
    auto cull = gpu::Program::compute(shaders, "terrane/render/cull.comp.glsl", {}, "cull");
    if (!cull) return tl::unexpected(cull.error());
    auto compact = gpu::Program::compute(shaders, "terrane/render/compact.comp.glsl", {}, "compact");
    if (!compact) return tl::unexpected(compact.error());
    pass.cull_ = std::move(*cull);
    pass.compact_ = std::move(*compact);
    pass.hasIndirectCount_ = device.indirectCount;
    const TwoCounts none{};
    pass.countBuffer_ = gpu::Buffer(std::as_bytes(std::span(none)), GL_DYNAMIC_STORAGE_BIT, "draw counts");
    for (Readback& readback : pass.readbacks_) {
        readback.buffer = gpu::ReadbackBuffer(sizeof(TwoCounts), "draw counts");
    }
    return pass;
}

// Each list has room for all faces of its draw bucket, so that none can overflow.
void CullPass::reserve(const MeshSectionTable& meshSections) {
    std::uint32_t sum = 0;
    for (std::uint32_t list = 0; list < shared::kDrawLists; ++list) {
        firstCommand_[list] = sum;
        const std::uint32_t bucket = list < shared::kCameraLists ? list : list - shared::kCameraLists;
        maxCommands_[list] = meshSections.maxCommands()[bucket];
        sum += maxCommands_[list];
    }
    const std::size_t commandBytes = std::max(sum, 1u) * sizeof(shared::DrawCommand);
    if (commandBytes > commands_.sizeBytes()) commands_ = gpuOnly(2 * commandBytes, "draw commands");
    const std::size_t wordBytes = meshSections.count() * sizeof(std::uint32_t);
    if (wordBytes > visible_.sizeBytes()) visible_ = gpuOnly(2 * wordBytes, "visible mesh sections");
    const std::size_t visibleLastFrameBytes = meshSections.slots() * sizeof(std::uint32_t);
    if (visibleLastFrameBytes <= visibleLastFrame_.sizeBytes()) return;
    visibleLastFrame_ = gpuOnly(2 * visibleLastFrameBytes, "mesh sections visible last frame");
    const GLuint zero = 0;
    glClearNamedBufferData(visibleLastFrame_.id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

// Mesh sections that were never tested count as hidden: the late pass draws them.
void CullPass::dispatch(const CullInput& input, const MeshSectionTable& meshSections, gpu::MappedRing& ring) {
    shared::CullFrame frame = frameOf(phase_, input, meshSections.count());
    for (std::uint32_t list = 0; list < shared::kDrawLists; ++list) {
        frame.firstCommand[list / 4][static_cast<int>(list % 4)] = firstCommand_[list];
    }
    const auto slice = ring.write(std::span<const shared::CullFrame>(&frame, 1));
    assert(slice && "the ring holds a frame's uniforms");
    ring.buffer().bindUniform(shared::kCullBinding, slice->offsetBytes, sizeof(frame));
    if (input.hiZ) input.hiZ->bind();
    meshSections.bindRecords();
    meshSections.bindOrder();
    visible_.bindStorage(shared::kVisibleBinding);
    visibleLastFrame_.bindStorage(shared::kVisibleLastFrameBinding);
    commands_.bindStorage(shared::kCommandsBinding);
    countBuffer_.bindStorage(shared::kCountsBinding);
    cull_.use();
    glDispatchCompute((meshSections.count() + shared::kCullThreads - 1) / shared::kCullThreads, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    compact_.use();
    glDispatchCompute(input.shadow ? shared::kDrawLists : shared::kCameraLists, 1, 1);
    // The late pass overwrites what the early one read.
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void CullPass::run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
                   gpu::MappedRing& ring) {
    const gpu::DebugGroup group("cull");
    phase_ = phase;
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

void CullPass::drawList(shared::uint list) const {
    if (maxCommands_[list] == 0) return;
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
    const auto offset =
        reinterpret_cast<const void*>(std::size_t{firstCommand_[list]} * sizeof(shared::DrawCommand));
    const auto maxCommands = static_cast<GLsizei>(maxCommands_[list]);
    if (hasIndirectCount_) {
        glBindBuffer(GL_PARAMETER_BUFFER_ARB, countBuffer_.id());
        const auto countOffset = static_cast<GLintptr>(countsOffset() + list * sizeof(shared::uint));
        glMultiDrawElementsIndirectCountARB(GL_TRIANGLES, GL_UNSIGNED_SHORT, offset, countOffset, maxCommands,
                                            0);
    } else {
        glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, offset, maxCommands, 0);
    }
}

void CullPass::drawBuckets(gpu::Pipeline& pipeline, gpu::PipelineState state, mesh::AlphaClass alphaClass,
                           bool forShadows) const {
    for (const bool isTwoSided : {false, true}) {
        state.cullsBackFaces = !isTwoSided;
        pipeline.set(state);
        const auto bucket = static_cast<shared::uint>(mesh::drawBucket(alphaClass, isTwoSided));
        drawList(forShadows ? shared::kCameraLists + bucket : bucket);
    }
}

// Not where the GPU is as many frames behind as there are buffers.
void CullPass::queueCounts() {
    counts();
    Readback& readback = readbacks_[nextReadback_];
    if (readback.isPending) return;
    readback.buffer.copyFrom(countBuffer_, sizeof(TwoCounts));
    readback.fence = gpu::Fence::insert();
    readback.isPending = true;
    nextReadback_ = (nextReadback_ + 1) % kReadbacks;
}

const shared::DrawCounts& CullPass::counts() {
    for (std::size_t k = 0; k < kReadbacks; ++k) {
        Readback& readback = readbacks_[(nextReadback_ + k) % kReadbacks];
        if (!readback.isPending || !readback.fence.passed()) continue;
        TwoCounts both;
        std::memcpy(both.data(), readback.buffer.data().data(), sizeof(both));
        counts_ = sumOf(both);
        readback.isPending = false;
    }
    return counts_;
}

std::vector<shared::DrawCommand> CullPass::readCommands(shared::uint list) const {
    shared::DrawCounts counts{};
    countBuffer_.download(countsOffset(), std::as_writable_bytes(std::span(&counts, 1)));
    std::vector<shared::DrawCommand> commands(counts.commands[list]);
    assert(commands.size() <= maxCommands_[list] && "each list has room for all commands");
    if (!commands.empty()) {
        commands_.download(firstCommand_[list] * sizeof(shared::DrawCommand),
                           std::as_writable_bytes(std::span(commands)));
    }
    return commands;
}

}  // namespace terrane::render
