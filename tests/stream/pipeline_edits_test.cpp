// Effects of edits on light and mesh on screen.
#include <set>

#include "terrane/shared/hash.h"
#include "tests/stream/pipeline_fixture.h"

namespace terrane::stream {
namespace {

class PipelineEditsTest : public PipelineTest {};

TEST_F(PipelineEditsTest, EditsMeshAgainTheChunksThatSeeThem) {
    setView({0, 0}, 2);
    settle();
    const auto changedBy = [&](world::BlockPos pos) {
        const auto before = shown_;
        placeBlock(pos, "sand");
        settle();
        expectShowsTheView();
        std::set<ChunkPos> changed;
        for (const auto& [at, shown] : shown_) {
            if (shown.mesh != before.at(at).mesh) changed.insert(at);
        }
        return changed;
    };
    using Chunks = std::set<ChunkPos>;
    EXPECT_EQ(changedBy({5, 9, 70}), (Chunks{{0, 0}}));
    EXPECT_EQ(changedBy({16, 9, 60}), (Chunks{{1, 0}, {0, 0}}));
    EXPECT_EQ(changedBy({-17, 9, 60}), (Chunks{{-2, 0}, {-1, 0}}));
    EXPECT_EQ(changedBy({5, 31, 60}), (Chunks{{0, 1}, {0, 2}}));
    EXPECT_EQ(changedBy({15, 0, 60}), (Chunks{{0, 0}, {1, 0}, {0, -1}}));
    EXPECT_EQ(changedBy({47, 5, 60}), (Chunks{{2, 0}})) << "the neighbor is not in view";
}

// Edits come faster than workers mesh: meshes in between may be dropped, the last may not.
TEST_F(PipelineEditsTest, TheNewestMeshWins) {
    setView({0, 0}, 1);
    settle();
    for (int round = 0; round < 40; ++round) {
        for (int k = 0; k < 6; ++k) placeBlock({15, 15, 80 + (round * 6 + k) % 100}, k % 2 ? "air" : "stone");
        if (round % 3 == 0) update();
        if (round % 5 == 0) take(1);
    }
    settle();
    expectShowsTheView();
}

// Light and mesh in progress when a block changes are computed again.
TEST_F(PipelineEditsTest, ResultsOfOldBlocksAreDropped) {
    setView({0, 0}, 1);
    for (int step = 0; step < 200 && !pipeline_->progress().complete(); ++step) {
        update();
        for (const ChunkPos pos : {ChunkPos{0, 0}, {1, 0}, {-1, 1}, {2, 2}}) {
            if (!world_.maybeChunkAt(pos)) continue;
            placeBlock({pos.x * 16 + 15, pos.y * 16 + step % 16, 70 + step % 7},
                       step % 2 ? "lamp_green" : "air");
        }
        pipeline_->waitForWorkers(std::chrono::milliseconds(1));
    }
    settle();
    expectShowsTheView();
}

TEST_F(PipelineEditsTest, AnEditIsOnScreenInTheNextUpdate) {
    setView({0, 0}, 1);
    settle();
    placeBlock({15, 3, 90}, "lamp_blue");
    update();
    take(kAll);
    expectShowsTheView();
}

// All light is sent and all chunks are meshed again, over many updates: edits do not wait for that.
TEST_F(PipelineEditsTest, EditsComeBeforeWhatIsShownAgain) {
    constexpr ChunkPos kLast{5, 5};
    setView({0, 0}, 5);
    settle();
    const auto expectEditIsNext = [&](const mesh::MeshOptions& options, int z) {
        placeBlock({kLast.x * 16 + 8, kLast.y * 16 + 8, z}, "stone");
        update();
        bool isThere = false;
        for (const ChunkChange& change : pipeline_->takeChanges(4)) {
            if (change.pos != kLast) continue;
            isThere = change.mesh && change.light;
            if (!isThere) continue;
            const mesh::ChunkMesh expected = directMesh(world_, kLast, options);
            EXPECT_EQ(*change.mesh,
                      change.meshSections == mesh::kAllMeshSections
                          ? expected
                          : mesh::withMeshSections(*change.mesh, expected, change.meshSections));
            EXPECT_EQ(*change.light, directLight(world_, kLast));
        }
        EXPECT_TRUE(isThere);
        settle();
        EXPECT_EQ(pipeline_->waitingChanges(), 0u);
    };
    pipeline_->resendLight();
    EXPECT_EQ(pipeline_->waitingChanges(), 121u);
    expectEditIsNext({}, 90);
    const mesh::MeshOptions none{mesh::MergeMethod::None, 16};
    pipeline_->setMeshOptions(none);
    expectEditIsNext(none, 100);
    for (const auto& [pos, shown] : shown_) {
        if (pos == kLast) continue;  // it was taken above
        EXPECT_EQ(*shown.mesh, directMesh(world_, pos, none));
    }
}

// As for a new store of light: no quads are sent with it.
TEST_F(PipelineEditsTest, LightIsSentAgainWithoutMeshes) {
    setView({0, 0}, 1);
    settle();
    pipeline_->resendLight();
    update();
    const std::vector<ChunkChange> changes = pipeline_->takeChanges(kAll);
    EXPECT_EQ(changes.size(), 9u);
    for (const ChunkChange& change : changes) {
        EXPECT_TRUE(change.light && change.bricks == world::SectionSet::all({}));
        EXPECT_TRUE(!change.mesh && !change.needsMesh);
    }
}

TEST_F(PipelineEditsTest, EditsOfWhatIsNotLoadedAreRefused) {
    setView({0, 0}, 1);
    EXPECT_FALSE(placeBlock({1000, 0, 60}, "sand"));
    EXPECT_FALSE(edit({1000, 0, 60}, world::SetState{3}));
    EXPECT_FALSE(edit({1000, 0, 60}, world::SetEntityData{{std::byte{1}}}));
    settle();
    EXPECT_FALSE(placeBlock({3, 3, 256}, "sand"));
    EXPECT_FALSE(placeBlock({3, 3, -1}, "sand"));
    expectShowsTheView();
    rest();
}

TEST_F(PipelineEditsTest, EditsOutOfViewAreHarmless) {
    setView({0, 0}, 0);
    settle();
    ASSERT_TRUE(placeBlock({20, 20, 90}, "sand")) << "active, and not visible";
    ASSERT_TRUE(pipeline_->chunkAt({40, 40}));
    ASSERT_TRUE(placeBlock({645, 645, 90}, "lamp_red"));
    settle();
    expectShowsTheView();
    setView({40, 40}, 1);
    settle();
    EXPECT_EQ(world_.block({645, 645, 90}), contentBlock("lamp_red"));
    expectShowsTheView();
}

TEST_F(PipelineEditsTest, PlantsAreMeshedByTheirStage) {
    setView({0, 0}, 0);
    settle();
    ASSERT_TRUE(placeBlock({3, 3, 100}, "dirt"));
    ASSERT_TRUE(placeBlock({3, 3, 101}, "wheat"));
    std::set<std::uint16_t> left;
    for (int stage = 3;; --stage) {
        left.insert(world_.blockState({3, 3, 101}));
        settle();
        expectShowsTheView();
        if (stage == 0) break;
        const auto before = shown_.at({0, 0}).mesh;
        ASSERT_TRUE(edit({3, 3, 101}, world::SetState{static_cast<std::uint16_t>(stage - 1)}));
        update();
        take(kAll);
        EXPECT_NE(*shown_.at({0, 0}).mesh, *before) << "stage " << stage - 1;
    }
    EXPECT_EQ(left, (std::set<std::uint16_t>{3, 2, 1, 0}));
}

TEST_F(PipelineEditsTest, AnEditNamesTheBricksWhoseLightItChanged) {
    setView({0, 0}, 1);
    settle();
    placeBlock({8, 8, 100}, "lamp_red");  // brick 6, 5 and 7 by its light, 4 by its shadow
    update();
    int lit = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        lit += change.light ? 1 : 0;
        world::SectionSet all = world::SectionSet::all({64, 128});
        if (change.pos == ChunkPos{0, 0}) {
            EXPECT_EQ(change.bricks, all);
        }
        all |= change.bricks;
        EXPECT_EQ(all.count(), 4u) << change.pos.x << ' ' << change.pos.y;
    }
    EXPECT_GE(lit, 5);
}

TEST_F(PipelineEditsTest, AnEditMeshesOnlyTheMeshSectionsItTouches) {
    pipeline_->setMeshOptions({mesh::MergeMethod::Greedy, 32});
    setView({0, 0}, 1);
    settle();
    placeBlock({15, 8, 95},
               "stone");  // in mesh section 2, below 3, and beside mesh section 2 of the next chunk
    update();
    std::map<ChunkPos, mesh::MeshSectionSet> meshed;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        if (!change.mesh) continue;
        meshed[change.pos] = change.meshSections;
        for (const mesh::MeshSection& section : change.mesh->meshSections)
            EXPECT_TRUE(change.meshSections.has(section)) << section.bottom;
    }
    ASSERT_EQ(meshed.size(), 2u);
    const auto touches = [&](ChunkPos pos, int bottom, int top) {
        return meshed.at(pos).hasAny(bottom, top);
    };
    EXPECT_TRUE(touches({0, 0}, 64, 96) && touches({0, 0}, 96, 128) && touches({1, 0}, 64, 96));
    EXPECT_FALSE(touches({0, 0}, 0, 64) || touches({0, 0}, 128, 256));
    EXPECT_FALSE(touches({1, 0}, 0, 64) || touches({1, 0}, 96, 256));
}

// In any order of edits, other options and taken changes, the shown meshes equal meshing all from scratch.
TEST_F(PipelineEditsTest, MeshSectionsOfManyEditsAddUp) {
    setView({0, 0}, 1);
    settle();
    mesh::MeshOptions options;
    for (unsigned step = 0; step < 200; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 77) % count);
        };
        if (random(0, 25) == 0)
            pipeline_->setMeshOptions(options = {mesh::MergeMethod::Greedy, 8 << random(1, 5)});
        placeBlock({random(2, 48) - 16, random(3, 48) - 16, 40 + random(4, 60)},
                   step % 3 == 0 ? "air" : "stone");
        if (random(5, 2) == 0) update();
        if (random(6, 4) == 0) take(static_cast<std::size_t>(random(7, 4)));
    }
    settle();
    for (const auto& [pos, shown] : shown_) {
        EXPECT_EQ(*shown.mesh, directMesh(world_, pos, options)) << pos.x << ' ' << pos.y;
    }
}

TEST_F(PipelineEditsTest, OfAChunkOnlyTheNewestMeshIsTaken) {
    setView({0, 0}, 1);
    settle();
    for (int round = 0; round < 3; ++round) {
        placeBlock({8, 8, 40 + round}, "sand");
        update();
    }
    EXPECT_EQ(take(kAll), 1u);
    expectShowsTheView();
}

TEST_F(PipelineEditsTest, EditsSurviveWhileTheirChunkStaysInView) {
    setView({0, 0}, 1);
    settle();
    placeBlock({3, 3, 90}, "lamp_red");
    for (const ChunkPos center : {ChunkPos{1, 0}, {2, 1}, {3, -1}, {0, 0}}) {
        setView(center, 1);
        settle();
    }
    EXPECT_EQ(world_.block({3, 3, 90}), contentBlock("lamp_red"));
    expectShowsTheView();
}

// If the caller meshes whole chunks, edits still come with their mesh, unless the chunk has none yet.
TEST_F(PipelineEditsTest, MeshesOfWholeChunksAreLeftOut) {
    pipeline_ = nullptr;
    world_ = {};
    pipeline_ = makePipeline({&generator_, nullptr, false}, MeshPolicy::Caller);
    setView({0, 0}, 1);
    for (update(); !pipeline_->progress().complete(); update()) {
        pipeline_->waitForWorkers(std::chrono::milliseconds(100));
    }
    placeBlock({8, 8, 80}, "stone");
    update();
    const std::vector<ChunkChange> changes = pipeline_->takeChanges(kAll);
    EXPECT_EQ(changes.size(), 9u);
    for (const ChunkChange& change : changes) {
        EXPECT_TRUE(change.needsMesh && !change.mesh && change.light) << change.pos.x << ' ' << change.pos.y;
        const mesh::MeshBlocks blocks = pipeline_->meshBlocks(change.pos);
        mesh::MeshScratch scratch;
        EXPECT_EQ(meshChunk(mesh::meshInput(blocks, contentBlocks(), {}), scratch),
                  directMesh(world_, change.pos));
    }
    placeBlock({8, 8, 90}, "stone");
    update();
    std::size_t meshed = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) {
        EXPECT_FALSE(change.needsMesh);
        meshed += change.mesh && change.meshSections != mesh::kAllMeshSections;
    }
    EXPECT_EQ(meshed, 1u);
    pipeline_->setMeshOptions({mesh::MergeMethod::None, 16});
    update();
    std::size_t again = 0;
    for (const ChunkChange& change : pipeline_->takeChanges(kAll)) again += change.needsMesh;
    EXPECT_EQ(again, 9u);
}

// An edit with an unlit chunk around it relights only the chunks around it; others are relit incrementally.
// The light equals lighting everything from scratch, in any order of chunks.
TEST_F(PipelineEditsTest, EditsWhileTheViewLoads) {
    for (unsigned round = 0; round < 4; ++round) {
        pipeline_ = nullptr;
        world_ = {};
        shown_.clear();
        pipeline_ = makePipeline({&generator_, nullptr, false});
        setView({0, 0}, 2);
        for (unsigned step = 0; step < 60 && !pipeline_->progress().complete(); ++step) {
            update();
            for (unsigned k = 0; k < 8; ++k) {
                const auto random = [&](unsigned n, unsigned count) {
                    return static_cast<int>(shared::hash3(step, k, n, round) % count);
                };
                const char* const kinds[] = {"air", "stone", "lamp_red", "lamp_blue"};
                placeBlock({random(0, 80) - 32, random(1, 80) - 32, 50 + random(2, 24)}, kinds[random(3, 4)]);
            }
            pipeline_->waitForWorkers(std::chrono::milliseconds(2));
            take(static_cast<std::size_t>(step % 7));
        }
        settle();
        expectShowsTheView();
        if (HasFatalFailure()) return;
    }
}

// One batch of 32³ blocks over several chunks.
TEST_F(PipelineEditsTest, AFillOfManyBlocksAtOnce) {
    setView({0, 0}, 2);
    settle();
    const auto fill = [&](std::string_view name) {
        std::vector<world::BlockEdit> edits;
        for (int z = 60; z < 92; ++z)
            for (int y = -9; y < 23; ++y)
                for (int x = -9; x < 23; ++x)
                    world::applyChange(world_, contentBlocks(), {x, y, z},
                                       world::SetBlock{contentBlock(name)}, edits);
        pipeline_->onEdits(edits);
        settle();
        expectShowsTheView();
    };
    fill("stone");
    fill("lamp_green");
    fill("air");
}

}  // namespace
}  // namespace terrane::stream
