// A small world under a ChunkPipeline, and a viewer that follows its changes as a renderer would.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <map>
#include <memory>

#include "terrane/gen/builder.h"
#include "terrane/stream/chunk_pipeline.h"
#include "tests/light/content_blocks.h"

namespace terrane::stream {

using world::ChunkPos;

// Columns of random height, so that every chunk's mesh differs and depends on its neighbours.
inline gen::Generator bumpyGenerator() {
    gen::GeneratorBuilder builder("bumpy", contentBlocks());
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Float height = gen::Float(60.0f) + gen::Float(8.0f) * p.random2D("height", p.x(), p.y());
        p.setBlock(select(gen::Float(p.z()) <= height, p.block("stone"), p.block("air")));
    });
    auto graph = builder.finish();
    if (!graph) throw std::runtime_error(graph.error().message);
    return gen::Generator(*std::move(graph), 1);
}

inline bool isWithin(ChunkPos pos, ChunkPos centre, int distance) {
    return world::isInWorld(pos) && world::chunkDistance(pos, centre) <= distance;
}

// The mesh that the chunk must have, made here and now.
inline mesh::ChunkMesh directMesh(const world::World& world, ChunkPos pos,
                                  const mesh::MeshOptions& options = {}) {
    static const world::Chunk kOutside;
    const auto chunk = [&](int dx, int dy) {
        const world::ChunkPtr loaded = world.maybeChunkAt({pos.x + dx, pos.y + dy});
        return loaded ? loaded.get() : &kOutside;  // the world keeps it alive
    };
    mesh::MeshInput input;
    input.centre = chunk(0, 0);
    input.neighbours = {chunk(-1, 0), chunk(1, 0), chunk(0, -1), chunk(0, 1)};
    input.blocks = &contentBlocks();
    input.options = options;
    mesh::MeshScratch scratch;
    return mesh::meshChunk(input, scratch);
}

class PipelineTest : public testing::Test {
  protected:
    static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

    void setView(ChunkPos centre, int distance) {
        centre_ = centre;
        distance_ = distance;
        pipeline_.setView(centre, distance);
        expectBounded();
    }

    void update() {
        pipeline_.update();
        expectBounded();
    }

    // Chunks stay in memory one ring beyond those that meshes need.
    void expectBounded() const {
        const std::size_t side = 2 * (static_cast<std::size_t>(distance_) + 2) + 1;
        ASSERT_LE(world_.chunks().size(), side * side);
        for (const auto& [pos, chunk] : world_.chunks()) ASSERT_TRUE(isWithin(pos, centre_, distance_ + 2));
    }

    // Shows what changed, and says how much that was.
    std::size_t take(std::size_t limit) {
        const std::vector<MeshChange> changes = pipeline_.takeMeshes(limit);
        EXPECT_LE(changes.size(), limit);
        for (const MeshChange& change : changes) {
            if (change.mesh) {
                shown_[change.pos] = change.mesh;
            } else {
                shown_.erase(change.pos);
                ++removals_[change.pos];
            }
        }
        return changes.size();
    }

    // Until the view is complete and no job is left.
    void settle() {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
        for (update(); !pipeline_.progress().complete(); update()) {
            ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the view is never complete";
            pipeline_.waitForWorkers(std::chrono::milliseconds(100));
        }
        jobs_.waitIdle();
        update();
        take(kAll);
    }

    void expectShowsTheView() const {
        std::size_t wanted = 0;
        for (int dy = -distance_; dy <= distance_; ++dy) {
            for (int dx = -distance_; dx <= distance_; ++dx) {
                const ChunkPos pos{centre_.x + dx, centre_.y + dy};
                if (!world::isInWorld(pos)) continue;
                ++wanted;
                const auto found = shown_.find(pos);
                ASSERT_NE(found, shown_.end()) << "chunk " << pos.x << ' ' << pos.y << " is not shown";
                ASSERT_EQ(*found->second, directMesh(world_, pos)) << "chunk " << pos.x << ' ' << pos.y;
            }
        }
        EXPECT_EQ(shown_.size(), wanted) << "chunks out of view are shown";
        EXPECT_EQ(pipeline_.progress().wanted, wanted);
        EXPECT_EQ(pipeline_.progress().visible, wanted);
    }

    void placeBlock(world::BlockPos pos, std::string_view name) {
        ASSERT_TRUE(world_.setBlock(pos, contentBlock(name)));
        pipeline_.blocksChanged(pos);
    }

    gen::Generator generator_ = bumpyGenerator();
    world::World world_;
    base::JobSystem jobs_{2};
    ChunkPipeline pipeline_{jobs_, generator_, contentBlocks(), world_};
    ChunkPos centre_;
    int distance_ = 0;
    std::map<ChunkPos, std::shared_ptr<const mesh::ChunkMesh>> shown_;
    std::map<ChunkPos, int> removals_;
};

}  // namespace terrane::stream
