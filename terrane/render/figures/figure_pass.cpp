#include "terrane/render/figures/figure_pass.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "terrane/render/corners/corners.h"
#include "terrane/render/frame/frame.h"
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

void FigurePass::bind(std::span<const shared::FigureRecord> figures, gpu::MappedRing& ring) const {
    assert(!figures.empty() && figures.size() <= shared::kMostFigures && "what figureRecords() gives");
    const auto slice = ring.allocate(kRingBytes);  // a block of uniforms is bound as a whole
    assert(slice && "the ring has room for the figures of a frame");
    std::memcpy(slice->data.data(), figures.data(), figures.size_bytes());
    ring.bindUniform(shared::kFiguresBinding, *slice);
}

void FigurePass::draw(const gpu::Program& program, std::size_t count) const {
    program.use();
    vertexArray_.bind();
    glDrawArraysInstanced(GL_TRIANGLES, 0, shared::kFigureBoxes * shared::kVerticesPerFigureBox,
                          static_cast<GLsizei>(count));
}

MaybePass makeFigures(FrameBuilder& build) {
    const auto* program = TERRANE_TRY(build.programs.graphics("figures/figure", "figures/figure",
                                                              FigureVariant{QuadPass::Surfaces}.defines()));
    CornerPrograms corners;
    const bool isAtCorners = build.options().shading == Shading::Corners;
    for (std::size_t k = 0; k < 2 && isAtCorners; ++k)
        corners.inAirAndWater[k] = TERRANE_TRY(build.programs.graphics(
            "figures/figure", "figures/figure", FigureVariant{QuadPass::Corners, k == 1}.defines()));
    const SharedTargets& targets = build.frame.targets;
    return Pass{.writes = {isAtCorners ? targets.image : targets.surfaces, targets.depth},
                .record =
                    [=](FrameContext& context) {
                        const bool atCorners = context.shadesAtCorners();
                        context.figures.bind(context.figuresInView, context.ring);
                        (atCorners ? context.frame.direct : context.frame.gbuffer)->bind();
                        context.worldTextures.bind();
                        context.pipeline.set({.depthTest = gpu::DepthTest::Greater});
                        context.figures.draw(atCorners ? corners.of(context) : *program,
                                             context.figuresInView.size());
                    },
                .isNeeded =
                    [](FrameContext& context) {
                        const FrameInput& input = context.input;
                        context.figuresInView = figureRecords(
                            input.figures, input.camera, context.culling.camera, double{input.fogDistance});
                        return !context.figuresInView.empty();
                    },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
