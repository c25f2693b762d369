// Tests stream/depth.h: the rule with records alone, and the pipeline of a tall world with caves, cliffs and
// lamps against a world of whole columns.
#include "terrane/stream/depth.h"

#include <cmath>
#include <map>
#include <string>

#include "terrane/shared/hash.h"
#include "terrane/store/overlay_store.h"
#include "terrane/stream/lighting.h"
#include "terrane/world/character.h"
#include "tests/stream/pipeline_fixture.h"
#include "tests/support/depth.h"

namespace terrane::stream {
namespace {

constexpr world::Heights kHeights{-256, 512};
constexpr int kFirst = -16;  // section

class DepthTest : public testing::Test {
  protected:
    DepthTest() { table_.heights = kHeights; }

    // Loads all chunks that the view needs. Each is made kClosedSections below its daylight, or deeper where
    // that is known.
    void load(int sunlit) {
        for (const ChunkPos pos : popLoadRequests(table_, 1000)) {
            const auto own = sunlit_.find(pos);
            const int daylight = own == sunlit_.end() ? sunlit : own->second;
            const int made = std::min(depthToLoad(table_, pos), daylight - kClosedSections);
            finishLoad(table_, pos, {}, {made, daylight});
        }
    }
    // Does all work, and returns the chunks that were made deeper.
    std::map<ChunkPos, int> settle() {
        std::map<ChunkPos, int> deeper;
        for (;;) {
            const auto depths = popDepthJobs(table_, 1000);
            for (const DepthJob& job : depths) {
                deeper[job.pos] = job.section;
                EXPECT_TRUE(finish(job));
                updateDepthAround(table_, job.pos);
            }
            const auto lit = popLightingRequests(table_, 1000);
            for (const ChunkPos pos : lit) {
                ++litTimes_[pos];
                finishLighting(table_, pos);
            }
            if (depths.empty() && lit.empty() && table_.toDeepen.empty()) return deeper;
        }
    }
    // Nothing new is open.
    bool finish(const DepthJob& job) {
        return finishDepthJob(table_, job.pos, {job.section, kHeights.endSection()});
    }
    int madeAt(ChunkPos pos) { return findRecord(table_, pos)->lowestMade; }

    ChunkTable table_;
    std::map<ChunkPos, int> sunlit_, litTimes_;
};

TEST_F(DepthTest, WithoutACameraChunksAreWhole) {
    setView(table_, {0, 0}, 1);
    load(4);
    EXPECT_TRUE(settle().empty());
    for (const auto& [pos, record] : table_.records) EXPECT_EQ(record.lowestMade, kFirst);
}

TEST_F(DepthTest, DaylightOfTheNeighborsCounts) {
    setCameraHeight(table_, 400);  // far above what daylight needs
    setView(table_, {0, 0}, 2);
    sunlit_[{1, 1}] = -3;
    load(10);
    const auto deeper = settle();
    for (const auto& [pos, section] : deeper) EXPECT_EQ(section, -5);
    // The chunks beside the low one are made as deep, and those beside them: they light them.
    for (const auto& [pos, record] : table_.records) {
        const bool isBeside = world::chunkDistance(pos, {1, 1}) <= 2;
        EXPECT_EQ(record.lowestMade, isBeside ? -5 : 8) << pos.x << ' ' << pos.y;
    }
    EXPECT_EQ(countOf(table_, ChunkStage::Visible), 25u);
}

TEST_F(DepthTest, TheOrderOfLoadingDoesNotCount) {
    std::map<ChunkPos, int> made[2];
    for (const bool isLowFirst : {false, true}) {
        table_ = {};
        table_.heights = kHeights;
        setCameraHeight(table_, 400);
        setView(table_, {0, 0}, 3);
        auto loads = popLoadRequests(table_, 1000);
        if (isLowFirst) std::ranges::reverse(loads);
        for (const ChunkPos pos : loads) {
            const int daylight = static_cast<int>(shared::hash2(pos.x, pos.y, 1) % 20) - 5;
            finishLoad(table_, pos, {},
                       {std::min(depthToLoad(table_, pos), daylight - kClosedSections), daylight});
        }
        settle();
        for (int y = -3; y <= 3; ++y)
            for (int x = -3; x <= 3; ++x) {
                ASSERT_TRUE(isAt(table_, {x, y}, ChunkStage::Visible));
                made[isLowFirst][{x, y}] = depthAround(table_, {x, y})->needed;
            }
    }
    EXPECT_EQ(made[0], made[1]);
}

TEST_F(DepthTest, AFallingCameraAsksForChunksNearIt) {
    setCameraHeight(table_, 400);
    setView(table_, {0, 0}, kNearChunks + 3);
    load(10);
    settle();
    litTimes_.clear();
    setCameraHeight(table_, 399);
    EXPECT_TRUE(settle().empty()) << "in the same step";
    setCameraHeight(table_, 100);
    const auto deeper = settle();
    EXPECT_EQ(deeper.size(), (2u * kNearChunks + 3) * (2u * kNearChunks + 3)) << "and what lights them";
    for (const auto& [pos, section] : deeper) EXPECT_EQ(section, 2) << "z = 32, at most 64 below 100";
    EXPECT_EQ(litTimes_.size(), (2u * kNearChunks + 5) * (2u * kNearChunks + 5));
    for (const auto& [pos, times] : litTimes_) EXPECT_EQ(times, 1) << pos.x << ' ' << pos.y;
    EXPECT_EQ(madeAt({kNearChunks + 3, 0}), 8);
    setCameraHeight(table_, -200);
    settle();
    EXPECT_EQ(madeAt({0, 0}), kFirst);
    EXPECT_EQ(countOf(table_, ChunkStage::Visible), table_.chunksInView) << "shown all the time";
}

TEST_F(DepthTest, AChunkHasOneJobAtATime) {
    setCameraHeight(table_, 400);
    setView(table_, {0, 0}, 0);
    load(10);
    requestDepth(table_, {0, 0}, 5);
    const auto first = popDepthJobs(table_, 10);
    ASSERT_EQ(first.size(), 1u);
    requestDepth(table_, {0, 0}, 3);
    EXPECT_TRUE(popDepthJobs(table_, 10).empty());
    EXPECT_TRUE(finish(first[0]));
    EXPECT_EQ(madeAt({0, 0}), 5);
    const auto second = popDepthJobs(table_, 10);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_EQ(second[0].section, 3);
    requestDepth(table_, {0, 0}, 4);  // less than what is on the way
    EXPECT_TRUE(finish(second[0]));
    EXPECT_TRUE(popDepthJobs(table_, 10).empty());
}

// The chunks that light it are unloaded meanwhile: nothing tells that it is lit as before.
TEST_F(DepthTest, AVisibleChunkThatIsLitInVainIsLitOnceThoseAroundItAreBack) {
    setCameraHeight(table_, 400);
    setView(table_, {0, 0}, 1);
    load(10);
    settle();
    litTimes_.clear();
    setCameraHeight(table_, 100);
    for (const DepthJob& job : popDepthJobs(table_, 1000)) {
        EXPECT_TRUE(finish(job));
        updateDepthAround(table_, job.pos);
    }
    const auto lit = popLightingRequests(table_, 1000);
    EXPECT_EQ(lit.size(), 9u);
    setView(table_, {-1, 0}, 1);
    popHidden(table_);
    for (const ChunkPos pos : findUnneeded(table_, Time() + std::chrono::hours(1))) unload(table_, pos);
    EXPECT_FALSE(findRecord(table_, {2, 0}));
    invalidateLighting(table_, {1, 0});
    for (const ChunkPos pos : lit) finishLighting(table_, pos);
    load(10);
    settle();
    EXPECT_FALSE(litTimes_.contains({1, 0}));
    setView(table_, {0, 0}, 1);
    load(10);
    settle();
    EXPECT_TRUE(litTimes_.contains({1, 0}));
}

TEST_F(DepthTest, AJobOfAChunkThatIsGoneIsForgotten) {
    setCameraHeight(table_, 400);
    setView(table_, {0, 0}, 0);
    load(10);
    settle();
    requestDepth(table_, {1, 1}, 0);
    const auto jobs = popDepthJobs(table_, 10);
    ASSERT_EQ(jobs.size(), 1u);
    setView(table_, {100, 0}, 0);
    popHidden(table_);
    for (const ChunkPos pos : findUnneeded(table_, Time() + std::chrono::hours(1))) unload(table_, pos);
    EXPECT_FALSE(finish(jobs[0]));
}

// Hills, a cliff of 150 blocks, caves through all of it, and lamps in them.
gen::Generator cavesGenerator() {
    gen::GeneratorBuilder builder("caves", contentBlocks());
    builder.declareHeights(kHeights);
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Float cliff = select(p.x() > 48, gen::Float(150.0f), gen::Float(0.0f));
        const gen::Float height = p.perlin2D("hills", 32, {30.0f}) + cliff + 60.0f;
        const gen::Bool isOpen = gen::Float(p.z()) > height || p.perlin3D("caves", 16, {1.0f}) > 0.4f;
        const gen::Bool isLamp = p.randomBool3D("lamps", gen::Float(0.002f), p.x(), p.y(), p.z());
        p.setBlock(select(isOpen, select(isLamp, p.block("lamp_red"), p.block("air")), p.block("stone")));
    });
    auto graph = builder.finish();
    if (!graph) throw std::runtime_error(graph.error().message);
    return gen::Generator(*std::move(graph), 5);
}

class DeepPipelineTest : public PipelineTest {
  protected:
    DeepPipelineTest() {
        pipeline_.reset();
        generator_ = cavesGenerator();
        world_ = world::World(kHeights);
        pipeline_ = makePipeline({&generator_, nullptr, false});
    }
    ~DeepPipelineTest() override { pipeline_.reset(); }

    // What is shown equals the light and the mesh of a world of whole columns, as deep as chunks must be
    // made.
    void expectShowsWholeColumns() {
        world::World whole(kHeights);
        world_.forEachChunk([&](ChunkPos pos, const world::ChunkPtr& chunk) {
            auto copy = std::make_shared<world::Chunk>(*chunk);
            copy->makeDeeper(generator_.generate(pos));
            whole.insert(pos, std::move(copy));
        });
        for (const auto& [pos, shown] : shown_) {
            if (world::chunkDistance(pos, center_) > distance_) continue;
            const light::ChunkLight light = directLight(whole, pos);
            const int highest = highestAround(pos);
            for (int n = highest + 1; n < kHeights.endSection(); ++n)
                ASSERT_EQ(shown.light->brick(n), light.brick(n))
                    << pos.x << ' ' << pos.y << ", section " << n;
            ASSERT_EQ(quadsFrom(*shown.mesh, highest + 1), quadsFrom(directMesh(whole, pos), highest + 1))
                << pos.x << ' ' << pos.y;
        }
    }
    // The rule of depth.h, from the blocks of whole columns.
    void expectIsDeepEnough(int cameraZ) {
        for (const auto& [pos, shown] : shown_) {
            if (world::chunkDistance(pos, center_) > distance_) continue;
            int lowestOpen = kHeights.endSection();
            for (const ChunkPos at : neighborhood(pos))
                lowestOpen = std::min(lowestOpen, lowestOpenOfWhole(at));
            const int needed = std::min((lowestOpen - kClosedSections) * 16, cameraZ - kNearBlocks);
            ASSERT_LE(highestAround(pos) * 16, std::max(needed, kHeights.bottom)) << pos.x << ' ' << pos.y;
        }
    }
    int lowestOpenOfWhole(ChunkPos pos) {
        const auto [known, isNew] = lowestOpen_.try_emplace(pos);
        if (isNew) known->second = light::lowestOpenSection(generator_.generate(pos), lightTable());
        return known->second;
    }
    int highestAround(ChunkPos pos) const {
        int highest = kFirst;
        for (const world::ChunkPtr& chunk : chunksAround(world_, pos))
            highest = std::max(highest, chunk->lowestMade());
        return highest;
    }
    // The quads of mesh sections from a section upward, with their places.
    static std::vector<std::pair<int, std::vector<shared::Quad>>> quadsFrom(const mesh::ChunkMesh& mesh,
                                                                            int section) {
        std::vector<std::pair<int, std::vector<shared::Quad>>> found;
        for (const mesh::MeshSection& part : mesh.meshSections) {
            if (part.bottom < section * world::kSectionSize) continue;
            const auto first = mesh.quads.begin() + firstQuad(part);
            found.push_back({part.bottom, {first, first + quadCount(part)}});
        }
        return found;
    }
    int lowestMade(ChunkPos pos) const { return world_.maybeChunkAt(pos)->lowestMade(); }

    std::map<ChunkPos, int> lowestOpen_;
};

TEST_F(DeepPipelineTest, ShowsWhatWholeColumnsShow) {
    pipeline_->setCameraHeight(500);
    setView({3, -2}, 4);
    settle();
    expectShowsTheView();
    expectShowsWholeColumns();
    int deepest = kHeights.endSection(), highest = kFirst;
    world_.forEachChunk([&](ChunkPos, const world::ChunkPtr& chunk) {
        deepest = std::min(deepest, chunk->lowestMade());
        highest = std::max(highest, chunk->lowestMade());
    });
    EXPECT_GT(deepest, kFirst) << "nothing needs the bottom";
    EXPECT_GT(highest, deepest + 4) << "a plateau needs less than the land under a cliff";
}

TEST_F(DeepPipelineTest, FollowsACameraDownAndBack) {
    for (const int z : {300, 40, -240, 300}) {
        pipeline_->setCameraHeight(z);
        setView({z / 100, 0}, 2);
        settle();
        expectShowsTheView();
        expectShowsWholeColumns();
        if (HasFatalFailure()) return;
        EXPECT_LE(lowestMade(center_) * 16, std::max(z - kNearBlocks, kHeights.bottom));
    }
}

TEST_F(DeepPipelineTest, AnOpenedShaftIsLitToItsFloor) {
    pipeline_->setCameraHeight(500);
    setView({0, 0}, 2);
    settle();
    // From far below the ground up to its surface, the last block at the top: daylight falls in at once.
    const world::BlockPos top{8, 8, 400};
    ASSERT_TRUE(pipeline_->chunkAt({0, 0}));
    settle();
    std::vector<world::BlockPos> shaft;
    for (int z = -200; z < top.z; ++z) shaft.push_back({top.x, top.y, z});
    for (const world::BlockPos pos : shaft) placeBlock(pos, "air");
    settle();
    expectShowsTheView();
    expectShowsWholeColumns();
    EXPECT_EQ(pipeline_->lightAt({8, 8, -200}), light::kFullDaylight);
    for (const world::ChunkPtr& chunk : chunksAround(world_, {0, 0}))
        EXPECT_LE(chunk->lowestMade() * 16, -200 - 16);
}

// A shaft down to a cave that is not made yet.
TEST_F(DeepPipelineTest, AShaftIntoACaveThatIsNotMadeIsLit) {
    gen::GeneratorBuilder builder("hall", contentBlocks());
    builder.declareHeights(kHeights);
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Bool isPillar = (p.x() & 7) == 0 && (p.y() & 7) == 0;
        const gen::Bool isHall = p.z() >= -200 && p.z() < 96 && !isPillar;
        p.setBlock(select(isHall || p.z() > 200, p.block("air"), p.block("stone")));
    });
    pipeline_.reset();
    generator_ = gen::Generator(builder.finish().value(), 1);
    pipeline_ = makePipeline({&generator_, nullptr, false});
    pipeline_->setCameraHeight(165);
    setView({0, 0}, 2);
    settle();
    ASSERT_EQ(lowestMade({0, 0}) * 16, 96);
    for (int z = 96; z <= 200; ++z) placeBlock({15, 8, z}, "air");
    settle();
    expectShowsTheView();
    expectShowsWholeColumns();
    EXPECT_EQ(pipeline_->lightAt({15, 8, -200}), light::kFullDaylight);
    for (const world::ChunkPtr& chunk : chunksAround(world_, {0, 0}))
        EXPECT_LE(chunk->lowestMade() * 16, -200 - 16);
}

TEST_F(DeepPipelineTest, AWalkWithEditsEndsRight) {
    pipeline_->setCameraHeight(300);
    unsigned count = 0;
    const auto between = [&](int low, int high) {
        return low + static_cast<int>(shared::hash2(++count, 0, 3) % static_cast<unsigned>(high - low + 1));
    };
    ChunkPos center;
    for (int step = 0; step < 80; ++step) {
        center.x += between(-1, 1);
        center.y += between(-1, 1);
        setView(center, between(1, 3));
        pipeline_->setCameraHeight(between(-5, 4) * 100);
        update();
        if (between(0, 2) == 0) pipeline_->waitForWorkers(std::chrono::milliseconds(5));
        take(static_cast<std::size_t>(between(0, 8)));
        now_ += std::chrono::milliseconds(between(0, 900));
        for (int k = between(0, 6); k > 0; --k)
            placeBlock({center.x * 16 + between(0, 15), center.y * 16 + between(0, 15), between(-256, 300)},
                       between(0, 1) == 0 ? "lamp_red" : "air");
    }
    rest();
    expectShowsTheView();
    expectShowsWholeColumns();
}

// Chunks on the ring stay visible while those beyond them are unloaded.
TEST_F(DeepPipelineTest, JumpsEndRight) {
    unsigned count = 0;
    const auto between = [&](int low, int high) {
        return low + static_cast<int>(shared::hash2(++count, 0, 7) % static_cast<unsigned>(high - low + 1));
    };
    ChunkPos center;
    for (int jump = 0; jump < atDepth(15, 1000); ++jump) {
        center = world::offsetBy(center, between(-2, 2), between(-2, 2));
        const int z = between(-2, 4) * 100;
        pipeline_->setCameraHeight(z);
        setView(center, between(1, 2));
        settle();
        expectShowsTheView();
        expectIsDeepEnough(z);
        if (HasFatalFailure()) FAIL() << "after jump " << jump;
        now_ += std::chrono::seconds(6);
        update();
    }
    expectShowsWholeColumns();
}

// A shaft under a roof: no daylight tells of it. The lighting of what is around goes on meanwhile.
TEST_F(DeepPipelineTest, APlayerFallsDownADarkShaftWithoutAStop) {
    constexpr world::Heights kDeep{-1024, 1040};
    gen::GeneratorBuilder builder("shaft", contentBlocks());
    builder.declareHeights(kDeep);
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Bool isShaft = p.x() >= 4 && p.x() < 12 && p.y() >= 4 && p.y() < 12;
        const gen::Bool isOpen = (isShaft && p.z() < 1000 && p.z() >= -1000) || p.z() > 1010;
        p.setBlock(select(isOpen, p.block("air"), p.block("stone")));
    });
    pipeline_.reset();
    generator_ = gen::Generator(builder.finish().value(), 1);
    world_ = world::World(kDeep);
    pipeline_ = makePipeline({&generator_, nullptr, false});
    world::Character player{.feet = {8, 8, 990}};
    pipeline_->setCameraHeight(990);
    setView({0, 0}, 3);
    settle();
    EXPECT_LE(lowestMade({0, 0}) * 16, 990 - kNearBlocks);
    int steps = 0;
    for (; steps < 60 * 120 && !player.isOnGround; ++steps) {
        const world::Character before = player;
        player = world::advanceCharacter(world_, contentBlocks(), player, {});
        ASSERT_LT(player.feet.z, before.feet.z) << "it waits at " << before.feet.z;
        if (steps % 2 != 0) continue;
        pipeline_->setCameraHeight(static_cast<int>(std::floor(player.feet.z + world::kEyeHeight)));
        update();
        jobs_.waitIdle();
    }
    EXPECT_NEAR(player.feet.z, -1000, 0.01);
    EXPECT_NEAR(steps / 120.0, 1990 / world::kFallLimit, 2.5) << "at the highest speed nearly all the time";
    settle();
    expectShowsTheView();
}

// An island in the sky, 25 chunks wide: no daylight falls on the land under its middle.
TEST_F(DeepPipelineTest, TheLandUnderAnIslandIsThere) {
    gen::GeneratorBuilder builder("island", contentBlocks());
    builder.declareHeights(kHeights);
    builder.pass3D("ground", [](gen::Pass& p) {
        const gen::Bool isIsland = abs(p.x()) < 200 && abs(p.y()) < 200 && p.z() > 300 && p.z() < 400;
        const gen::Bool isLand = gen::Float(p.z()) < p.perlin2D("hills", 32, {20.0f}) + 40.0f;
        p.setBlock(select(isIsland || isLand, p.block("stone"), p.block("air")));
    });
    pipeline_.reset();
    generator_ = gen::Generator(builder.finish().value(), 1);
    pipeline_ = makePipeline({&generator_, nullptr, false});
    pipeline_->setCameraHeight(450);
    setView({14, 0}, 6);
    settle();
    expectShowsTheView();
    expectShowsWholeColumns();
    for (int x = 14 - 6; x <= 14 + 6; ++x) EXPECT_LE(lowestMade({x, 0}), 2) << x;
    EXPECT_GT(lowestMade({14, 0}), kFirst + 4);
}

TEST_F(DeepPipelineTest, ARequestedChunkIsWhole) {
    pipeline_->setCameraHeight(300);
    setView({0, 0}, 1);
    settle();
    EXPECT_GT(lowestMade({1, 0}), kFirst);
    EXPECT_EQ(pipeline_->maybeLoadChunkAt({1, 0}), nullptr);
    ASSERT_TRUE(pipeline_->chunkAt({1, 0}));
    EXPECT_EQ(lowestMade({1, 0}), kFirst);
    EXPECT_EQ(*pipeline_->chunkAt({40, 40}), generator_.generate({40, 40}));
}

TEST_F(DeepPipelineTest, BlocksThatAreNotMadeCannotBeSet) {
    pipeline_->setCameraHeight(500);
    setView({0, 0}, 1);
    settle();
    ASSERT_FALSE(world_.isMade({8, 8, -256}));
    EXPECT_FALSE(placeBlock({8, 8, -256}, "lamp_red"));
    EXPECT_EQ(world_.block({8, 8, -256}), world::kUnmade);
}

TEST_F(DeepPipelineTest, EditedChunksAreSavedWhole) {
    store::MemoryStore store({1, "caves", 0, kHeights});
    pipeline_ = makePipeline({&generator_, &store, true});
    pipeline_->setCameraHeight(500);
    setView({0, 0}, 1);
    settle();
    EXPECT_FALSE(store.contains({0, 0})) << "what is not whole is generated again";
    const world::BlockPos pos{8, 8, 450};
    ASSERT_TRUE(placeBlock(pos, "lamp_red"));
    pipeline_->saveAll();
    ASSERT_TRUE(store.flush().has_value());
    world::Chunk expected = generator_.generate({0, 0});
    expected.setBlock(world::blockIndex(pos), contentBlock("lamp_red"));
    EXPECT_EQ(*store.load({0, 0}).chunk, expected);
    settle();
    EXPECT_EQ(*world_.maybeChunkAt({0, 0}), expected) << "it is made whole";
}

}  // namespace
}  // namespace terrane::stream
