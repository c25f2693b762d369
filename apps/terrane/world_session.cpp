#include "apps/terrane/world_session.h"

#include "apps/terrane/content.h"
#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks) {
    auto graph = gen::makeGenerator(options.generator, blocks);
    if (!graph) return tl::unexpected(graph.error());
    return gen::Generator(std::move(*graph), options.seed);
}

WorldSession::WorldSession(world::BlockRegistry registry, const WorldOptions& options)
    : blocks(std::move(registry)), jobs(threadCount(options)) {}

base::Result<std::unique_ptr<WorldSession>> WorldSession::create(const WorldOptions& options) {
    auto blocks = loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto session = std::make_unique<WorldSession>(std::move(*blocks), options);
    auto generator = makeGenerator(options, session->blocks);
    if (!generator) return tl::unexpected(generator.error());
    session->generator = std::make_unique<gen::Generator>(std::move(*generator));
    session->pipeline = std::make_unique<stream::ChunkPipeline>(session->jobs, *session->generator,
                                                                session->blocks, session->world);
    return session;
}

void uploadMeshes(stream::ChunkPipeline& pipeline, render::Renderer& renderer, std::size_t limit) {
    for (const stream::MeshChange& change : pipeline.takeMeshes(limit)) {
        if (change.mesh) {
            renderer.setChunk(change.pos, *change.mesh);
        } else {
            renderer.removeChunk(change.pos);
        }
    }
}

}  // namespace terrane::app
