// A session of the overworld with a renderer, as in a command, for tests that compare images.
#pragma once

#include <memory>
#include <optional>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/overlay_store.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"
#include "tests/golden/golden_fixture.h"

namespace terrane::view {

// The parts refer to each other by address.
struct DrawnSession {
    std::unique_ptr<GpuBackEnds> backEnds;
    std::unique_ptr<game::Session> session;
    render::Renderer renderer;
    std::optional<WorldView> view;

    base::Image draw(const render::FrameInput& input) {
        renderer.draw(input);
        return renderer.readImage();
    }
};

struct DrawnSessionOptions {
    glm::ivec2 size{96, 64};
    int viewDistance = 4;
    render::RenderOptions render = render::plainOptions(1);
    std::size_t memoryBudget = SIZE_MAX;
    render::QuadStoreSizes quads = {};
    std::unique_ptr<store::ChunkStore> store = nullptr;   // null: one in memory
    gen::LevelGenerators::MakeGraph makeGraph = nullptr;  // null: the overworld
    world::Heights heights = {};
    bool generatesOnGpu = false;  // and lights
    bool meshesOnGpu = false;
};

inline std::unique_ptr<DrawnSession> makeDrawnSession(DrawnSessionOptions options) {
    auto made = std::make_unique<DrawnSession>();
    if (!options.makeGraph)
        options.makeGraph = [](int level) { return gen::makeGenerator("overworld", contentBlocks(), level); };
    game::SessionParts parts{std::make_unique<const world::BlockRegistry>(contentBlocks()),
                             gen::LevelGenerators(options.makeGraph, 1, options.heights),
                             std::move(options.store), 2};
    if (!parts.store)
        parts.store =
            std::make_unique<store::MemoryStore>(store::WorldIdentity{1, "overworld", 1, options.heights});
    if (options.generatesOnGpu) {
        const auto graph = gen::makeGenerator("overworld", contentBlocks()).value();
        made->backEnds = makeGpuBackEnds(render::contentShaders(), graph, 1, contentBlocks()).value();
        useBackEnds(parts, *made->backEnds);
    }
    if (options.meshesOnGpu) parts.meshing = stream::MeshPolicy::Caller;
    made->session = std::make_unique<game::Session>(std::move(parts));
    made->renderer = render::Renderer::create(render::contentShaders(), contentBlocks(),
                                              render::contentTexture, gpu::queryDevice(), options.quads)
                         .value();
    made->renderer.setMemoryBudget(options.memoryBudget);
    EXPECT_TRUE(made->renderer.configure(options.size, options.render));
    made->renderer.setViewDistance(options.viewDistance);
    made->view.emplace(*made->session, made->renderer);
    if (options.meshesOnGpu) {
        EXPECT_TRUE(made->view->meshOnGpu(render::contentShaders(), WorldView::kNoLimit));
    }
    return made;
}

}  // namespace terrane::view
