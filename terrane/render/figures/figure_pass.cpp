#include "terrane/render/figures/figure_pass.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"
#include "terrane/world/character.h"

namespace terrane::render {

namespace {

// Players may stand at one place, as at the spawn: from inside a figure the camera would see back faces.
bool isWithin(const world::Figure& figure, const glm::dvec3& camera) {
    constexpr double kAside = 0.4, kUnder = world::kEyeHeight + 0.1, kOver = 0.3;  // of the eyes
    const glm::dvec3 from = camera - figure.eyes;
    return std::abs(from.x) < kAside && std::abs(from.y) < kAside && from.z > -kUnder && from.z < kOver;
}

shared::FigureRecord recordOf(const world::Figure& figure, glm::vec3 feet) {
    shared::FigureRecord record{};
    record.feet = glm::vec4(feet, glm::radians(figure.bodyYaw));
    record.pose = {glm::radians(figure.yaw), glm::radians(figure.pitch), figure.stride, figure.strideSize};
    record.swing = figure.swing;
    record.look = figure.look;
    return record;
}

}  // namespace

std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks) {
    const glm::dvec3 corner = cornerOfChunk(cameraChunk(camera)) + glm::dvec3(0, 0, world::kEyeHeight);
    struct Seen {
        double distance;
        shared::FigureRecord record;
    };
    std::vector<Seen> seen;
    for (const world::Figure& figure : figures) {
        const double distance = glm::distance(figure.eyes, camera.position);
        const glm::vec3 feet(figure.eyes - corner);
        if (isWithin(figure, camera.position)) continue;
        if (distance < farBlocks && mayBeVisible(planes, feet + kFigureLow, feet + kFigureHigh))
            seen.push_back({distance, recordOf(figure, feet)});
    }
    std::ranges::stable_sort(seen, {}, &Seen::distance);
    if (seen.size() > shared::kMostFigures) seen.resize(shared::kMostFigures);
    std::vector<shared::FigureRecord> records;
    records.reserve(seen.size());
    for (const Seen& s : seen) records.push_back(s.record);
    return records;
}

FigurePass::FigurePass(const gpu::ShaderLoader& shaders)
    : surfaces_(shaders, "terrane/render/figures/figure.vert.glsl", "terrane/render/figures/figure.frag.glsl",
                "figures"),
      shadows_(shaders, "terrane/render/figures/figure.vert.glsl",
               "terrane/render/figures/figure_shadow.frag.glsl", "shadows of figures"),
      vertexArray_("figures") {}

base::Result<void> FigurePass::select(bool castsShadows) {
    auto selected = surfaces_.select(defined({{"PASS", 0}}));
    if (selected && castsShadows) selected = shadows_.select(defined({{"PASS", 2}}));
    return selected;
}

void FigurePass::bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const {
    assert(!figures.empty() && figures.size() <= shared::kMostFigures && "what figureRecords() gives");
    const auto slice = ring.allocate(kRingBytes);  // a block of uniforms is bound as a whole
    assert(slice && "the ring has room for the figures of a frame");
    std::memcpy(slice->data.data(), figures.data(), figures.size_bytes());
    ring.bindUniform(shared::kFiguresBinding, *slice);
}

void FigurePass::draw(gpu::Pipeline& pipeline, const FrameTargets& targets, std::size_t count) const {
    const gpu::DebugGroup group("figures");
    targets.gbuffer.bind();
    pipeline.set({.depthTest = gpu::DepthTest::Greater});
    surfaces_.use();
    drawInstances(count);
}

void FigurePass::drawShadows(std::size_t count) const {
    shadows_.use();
    drawInstances(count);
}

void FigurePass::drawInstances(std::size_t count) const {
    vertexArray_.bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, shared::kFigureBoxes * shared::kVerticesPerFigureBox,
                          static_cast<GLsizei>(count));
}

}  // namespace terrane::render
