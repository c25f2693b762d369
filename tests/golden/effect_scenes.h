// Scenes of the golden images of effects: a glade of the overworld and its surroundings, drawn with plain
// options and one effect each.
#pragma once

#include <thread>

#include "terrane/stream/chunk_pipeline.h"
#include "tests/golden/golden_fixture.h"

namespace terrane::golden {

// Loads a small part of the overworld around a camera, generated and meshed as in the program.
inline void loadOverworld(render::Renderer& renderer, const render::Camera& camera, int viewDistance,
                          const mesh::MeshOptions& options = {}) {
    auto graph = gen::makeGenerator("overworld", contentBlocks());
    if (!graph) throw std::runtime_error(graph.error().message);
    const gen::Generator generator(*std::move(graph), 1);
    world::World world;
    base::JobSystem jobs(std::max(1u, std::thread::hardware_concurrency()));
    const light::LightTable lights(contentBlocks());
    stream::ChunkPipeline pipeline(
        {jobs, contentBlocks(), lights, world, {&generator, nullptr, false}, nullptr});
    pipeline.setMeshOptions(options);
    pipeline.setView(render::cameraChunk(camera), viewDistance);
    for (pipeline.update(); !pipeline.progress().complete(); pipeline.update()) {
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
    }
    for (const stream::ChunkChange& change : pipeline.takeChanges(std::numeric_limits<std::size_t>::max())) {
        if (change.mesh) renderer.setChunk(change.pos, *change.mesh, change.meshSections);
        if (change.light) renderer.setLight(change.pos, *change.light);
    }
}

constexpr int kGladeDistance = 7;  // chunks
// Trees, flowers, a river; toward the sun in the afternoon.
inline const render::Camera kGlade{{-1020, -60, 92}, 200, -2};
inline const render::Camera kTowardSun{{-1020, -60, 92}, 350, 24};

inline render::FrameInput gladeFrame(const render::Camera& camera, float timeDay) {
    return {camera, world::environmentAt(timeDay), 16.0f * kGladeDistance, 2, render::View::Color};
}

}  // namespace terrane::golden
