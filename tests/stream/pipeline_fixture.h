// A small world under a ChunkPipeline, and a viewer that follows its changes as a renderer would.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <memory>

#include "terrane/gen/language/builder.h"
#include "terrane/stream/chunk_pipeline.h"
#include "tests/base/wait_until.h"
#include "tests/support/default_heights.h"
#include "tests/world/content_blocks.h"

namespace terrane::stream {

using world::ChunkPos;

// Columns of random height, so that every chunk's mesh differs and depends on its neighbors.
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

inline bool isWithin(ChunkPos pos, ChunkPos center, int distance) {
    return world::isInWorld(pos) && world::chunkDistance(pos, center) <= distance;
}

inline std::array<world::ChunkPtr, 9> chunksAround(const world::World& world, ChunkPos pos) {
    std::array<world::ChunkPtr, 9> chunks;
    for (int n = 0; n < 9; ++n) {
        chunks[static_cast<std::size_t>(n)] = world.maybeChunkAt({pos.x + n % 3 - 1, pos.y + n / 3 - 1});
    }
    return chunks;
}

// The expected mesh of a chunk, made at once.
inline mesh::ChunkMesh directMesh(const world::World& world, ChunkPos pos,
                                  const mesh::MeshOptions& options = {}) {
    return *meshOf(meshBlocksOf(chunksAround(world, pos)), contentBlocks(), options);
}
inline const light::LightTable& lightTable() {
    static const light::LightTable table(contentBlocks());
    return table;
}
inline light::ChunkLight directLight(const world::World& world, ChunkPos pos) {
    return *lightOf({chunksAround(world, pos), {}, {}}, lightTable());
}

class PipelineTest : public testing::Test {
  protected:
    static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

    void setView(ChunkPos center, int distance) {
        center_ = center;
        distance_ = distance;
        pipeline_->setView(center, distance);
    }

    void update() { pipeline_->update(now_); }

    // Shows the changes and returns their number.
    std::size_t take(std::size_t limit) {
        const std::vector<ChunkChange> changes = pipeline_->takeChanges(limit);
        EXPECT_LE(changes.size(), limit);
        for (const ChunkChange& change : changes) {
            if (change.isHidden) {
                shown_.erase(change.pos);
                ++removals_[change.pos];
                continue;
            }
            Shown& shown = shown_[change.pos];
            if (change.mesh) shown.mesh = withMeshSections(shown.mesh, change);
            if (change.light) shown.light = withBricks(shown.light, change);
        }
        return changes.size();
    }

    static MeshPtr withMeshSections(const MeshPtr& old, const ChunkChange& change) {
        if (change.meshSections == mesh::kAllMeshSections) return change.mesh;
        return std::make_shared<mesh::ChunkMesh>(
            mesh::withMeshSections(*old, *change.mesh, change.meshSections));
    }

    // As a renderer that uploads only the changed bricks.
    static light::ChunkLightPtr withBricks(const light::ChunkLightPtr& old, const ChunkChange& change) {
        if (!old) return change.light;
        auto light = std::make_shared<light::ChunkLight>(*old);
        change.bricks.forEach([&](int n) { light->setBrick(n, change.light->brick(n)); });
        return light;
    }

    // Updates until the view is complete and no job is left.
    void settle() {
        update();
        const auto step = [this] {
            pipeline_->waitForWorkers(std::chrono::milliseconds(100));
            update();
        };
        ASSERT_TRUE(base::waitUntil([this] { return pipeline_->progress().isUpToDate(); }, step));
        jobs_.waitIdle();
        update();
        take(kAll);
    }

    // Six seconds without changes: only what the view needs stays in memory.
    void rest() {
        settle();
        update();
        now_ += std::chrono::seconds(6);
        update();
        const std::size_t side = 2 * (static_cast<std::size_t>(distance_) + 1) + 1;
        ASSERT_LE(world_.chunkCount(), side * side);
        world_.forEachChunk([&](ChunkPos pos, const world::ChunkPtr&) {
            ASSERT_TRUE(isWithin(pos, center_, distance_ + 1));
        });
    }

    void expectShowsTheView() const {
        std::size_t wanted = 0;
        for (int dy = -distance_; dy <= distance_; ++dy) {
            for (int dx = -distance_; dx <= distance_; ++dx) {
                const ChunkPos pos{center_.x + dx, center_.y + dy};
                if (!world::isInWorld(pos)) continue;
                ++wanted;
                const auto found = shown_.find(pos);
                ASSERT_NE(found, shown_.end()) << "chunk " << pos.x << ' ' << pos.y << " is not shown";
                ASSERT_EQ(*found->second.mesh, directMesh(world_, pos)) << "chunk " << pos.x << ' ' << pos.y;
                ASSERT_EQ(*found->second.light, directLight(world_, pos))
                    << "chunk " << pos.x << ' ' << pos.y;
            }
        }
        for (const auto& [pos, shown] : shown_) EXPECT_TRUE(isWithin(pos, center_, distance_ + 1));
        EXPECT_EQ(pipeline_->progress().inView, wanted);
        EXPECT_EQ(pipeline_->progress().visible, wanted);
    }

    // Edits as terrane/game does. False if nothing changed.
    bool edit(world::BlockPos pos, const world::BlockChange& change) {
        std::vector<world::BlockEdit> edits;
        world::applyChange(world_, contentBlocks(), pos, change, edits);
        pipeline_->onEdits(edits);
        return !edits.empty();
    }
    bool placeBlock(world::BlockPos pos, std::string_view name) {
        return edit(pos, world::SetBlock{contentBlock(name)});
    }

    std::unique_ptr<ChunkPipeline> makePipeline(ChunkSource source,
                                                MeshPolicy meshing = MeshPolicy::Workers) {
        return std::make_unique<ChunkPipeline>(
            PipelineParts{jobs_, contentBlocks(), lightTable(), world_, source, nullptr, nullptr, meshing});
    }

    struct Shown {
        MeshPtr mesh;
        light::ChunkLightPtr light;
        bool operator==(const Shown&) const = default;
    };

    gen::Generator generator_ = bumpyGenerator();
    world::World world_;
    base::JobSystem jobs_{2};
    ChunkPipeline::Time now_{};
    std::unique_ptr<ChunkPipeline> pipeline_ = makePipeline({&generator_, nullptr, false});
    ChunkPos center_;
    int distance_ = 0;
    std::map<ChunkPos, Shown> shown_;
    std::map<ChunkPos, int> removals_;
};

}  // namespace terrane::stream
