#include "terrane/gen_gpu/gpu_generator.h"

#include <algorithm>
#include <functional>
#include <string>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/gen/batch_generator_cases.h"
#include "tests/gen/stamp_fixture.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::gen_gpu {
namespace {

using world::ChunkPos;

// The first block in which two chunks differ, or nothing.
std::string difference(const world::Chunk& a, const world::Chunk& b) {
    if (a.heights() != b.heights()) return "their heights differ";
    const world::Heights heights = a.heights();
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        if (a.section(number) == b.section(number)) continue;
        for (int k = 0; k < world::kBlocksPerSection; ++k) {
            const int one = a.section(number).get(k), other = b.section(number).get(k);
            if (one != other) {
                return fmt::format("x {} y {} z {}: {} and {}", k & 15, k >> 4 & 15, 16 * number + (k >> 8),
                                   one, other);
            }
        }
    }
    return "";
}

class GpuGeneratorTest : public gpu::GlTest {
  protected:
    // Generates all chunks on both back ends, the GPU in batches of `batch`, and compares them block by
    // block.
    void compare(const std::string& name, const std::vector<ChunkPos>& chunks, std::size_t batch,
                 world::Heights heights = {}) {
        const auto graph = gen::makeGenerator(name, contentBlocks(), {chunks.front().level, heights});
        ASSERT_TRUE(graph) << graph.error().message;
        compare(*graph, chunks, batch);
    }

    void compare(const gen::GeneratorGraph& graph, const std::vector<ChunkPos>& chunks, std::size_t batch) {
        const gen::Generator cpu(graph, kSeed);
        auto onGpu = GpuGenerator::create(render::contentShaders(), graph, kSeed);
        ASSERT_TRUE(onGpu) << onGpu.error().message;
        std::size_t compared = 0;
        while (compared < chunks.size()) {
            const std::size_t count = std::min(batch, chunks.size() - compared);
            ASSERT_GT(onGpu->submit(std::span(chunks).subspan(compared, count)), 0u);
            const auto done = onGpu->take(true);
            ASSERT_FALSE(done.empty());
            for (const auto& [pos, chunk] : done) {
                ASSERT_EQ(difference(cpu.generate(pos), *chunk), "")
                    << graph.name << " chunk " << pos.x << "," << pos.y << " of level " << int{pos.level};
                ++compared;
            }
        }
        EXPECT_EQ(compared, chunks.size());
    }

    static constexpr std::uint64_t kSeed = 12345;
};

TEST_F(GpuGeneratorTest, DoesWhatEveryBackEndDoes) {
    const auto graph = gen::makeGenerator("hills3d", contentBlocks());
    ASSERT_TRUE(graph) << graph.error().message;
    auto batches = GpuGenerator::create(render::contentShaders(), *graph, kSeed);
    ASSERT_TRUE(batches) << batches.error().message;
    EXPECT_EQ(batches->backend(), "gpu");
    gen::expectBatchGeneratorCases(*batches, gen::Generator(*graph, kSeed));
}

TEST_F(GpuGeneratorTest, FlatEqualsCpu) {
    compare("flat", gen::chunksInSquare({-1, -1}, 3), 9);
}

TEST_F(GpuGeneratorTest, OtherGeneratorsEqualCpu) {
    for (const char* name : {"hills3d", "voronoi"}) {
        compare(name, gen::chunksInSquare({-2, -1}, 3), 9);
        compare(name, gen::chunksInSquare({world::kMinChunk, world::kMaxChunk - 1}, 2), 4);
    }
}

// Numbers from every part of the language, so different that a wrong bit somewhere shows.
void writeEverything(gen::GeneratorBuilder& g) {
    using namespace gen;
    const auto slope = g.field<Float>("slope"), wave = g.field<Float>("wave");
    const auto steps = g.field<Int>("steps"), found = g.field<Int>("found");
    const auto bits = [](Float f) { return (floatBits(f) >> 3) ^ floatBits(f); };
    g.pass2D("flat", [&](Pass& p) {
        const Vec2 gradient = p.perlin2DGradient("hills", 13, {1.0f, 0.0f, 2.0f});
        const Float hills = p.perlin2D("hills", 13, {1.0f, 0.0f, 2.0f}),
                    turn = p.simplex2D("turn", 11, {1.0f, 3.0f});
        const Stripes2D stripes = p.stripes2D("stripes", 21, {hills, turn});
        p.set(slope, length(gradient) + hills + stripes.cosine - stripes.sine);
        p.set(wave, sin(turn * 40.0f) + cos(Float(p.x() & 1023)) * pow(abs(hills), 0.85f) + log2(abs(turn)));
        Var<Int> n = p.var((p.x() & 255) + 1), count = p.var(Int(0));
        p.while_([&] { return n != Int(1); },
                 [&] {
                     n = select((n & Int(1)) == 0, n >> 1, Int(n) * 3 + 1);
                     count = count + 1;
                 });
        p.set(steps, floorDivide(p.y(), 7) * 3 + Int(count));
    });
    g.pass3D("solid", [&](Pass& p) {
        const Voronoi3D cells = p.voronoi3D("cells", 19, 3, 3);
        const Vec3 gradient = p.perlin3DGradient("rock", 9, {1.0f, .5f});
        const Float rock = p.perlin3D("rock", 9, {1.0f, .5f}) + p.simplex3D("grain", 10, {1.0f});
        Var<Int> sum = p.var(bits(cells.distance) + bits(cells.ratio) + cells.offset.x * 3 - cells.offset.z);
        p.if_(rock > 0.0f, [&] { sum = sum + bits(dot(gradient, gradient)) + bits(exp2(rock * 9.0f)); });
        p.setBlock(Block((sum ^ bits(rock) ^ (sum << 5)) | (p.z() & 1)));
        p.setAt(found, p.read(steps) & 255, sum + p.z());
    });
    g.pass3D("reads", [&](Pass& p) {
        const Int dx = p.read(steps) & 15, there(p.blockAt({dx, Int(3) - dx}, p.z() + 5));
        const Int around = p.readAt(found, {-9, dx}) + bits(p.readAt(slope, {dx, 0}));
        p.setBlock(Block(Int(p.blockHere()) * 3 + there + around + bits(p.read(wave))));
    });
}

TEST_F(GpuGeneratorTest, EveryPartOfTheLanguageEqualsCpu) {
    const world::BlockRegistry& blocks = contentBlocks();
    gen::GeneratorBuilder builder("everything", blocks);
    writeEverything(builder);
    const auto graph = builder.finish();
    ASSERT_TRUE(graph) << graph.error().message;
    compare(*graph, gen::chunksInSquare({-1, -2}, 1), 1);
    compare(*graph, gen::chunksInSquare({12345, -6789}, 1), 1);
    compare(*graph, gen::chunksInSquare({world::kMinChunk, world::kMaxChunk}, 1), 1);
    // Lattices of 13 and cells of 19 blocks at 4 and 8 blocks a column, half and wholly faded.
    for (const std::uint8_t level : {2, 3}) {
        gen::GeneratorBuilder ofLevel("everything", blocks, level);
        writeEverything(ofLevel);
        const auto far = ofLevel.finish();
        ASSERT_TRUE(far) << far.error().message;
        compare(*far, gen::chunksInSquare({123, -67, level}, 1), 1);
    }
}

TEST_F(GpuGeneratorTest, StampsEqualCpu) {
    const ChunkPos corner = {world::kMinChunk, world::kMaxChunk};
    for (const std::uint8_t level : {0, 2}) {
        gen::GeneratorBuilder builder("stamps", contentBlocks(), level);
        gen::writeStamps(builder, {60}, {8, 1000});
        const auto graph = builder.finish();
        ASSERT_TRUE(graph) << graph.error().message;
        compare(*graph, gen::chunksInSquare({-1, -1, level}, 2), 4);
        compare(*graph, {{corner.x >> level, corner.y >> level, level}}, 1);
    }
}

// Layers that are no multiple of a work group's, below and above zero.
constexpr world::Heights kSomeHeights[] = {{-64, 320}, {512, 1024}, {-2048, -2032}, {2032, 2048}, {-80, 32}};
constexpr world::Heights kTallest = {world::kLowestBottom, world::kHighestTop};

TEST_F(GpuGeneratorTest, EveryPartOfTheLanguageEqualsCpuAtAnyHeights) {
    for (const world::Heights heights : kSomeHeights) {
        SCOPED_TRACE(world::describe(heights));
        gen::GeneratorBuilder builder("everything", contentBlocks(), {0, heights});
        writeEverything(builder);
        const auto graph = builder.finish();
        ASSERT_TRUE(graph) << graph.error().message;
        compare(*graph, {{-3, 17}}, 1);
        if (HasFatalFailure()) return;
    }
}

// Feet in all layers, and some beyond.
TEST_F(GpuGeneratorTest, StampsEqualCpuAtAnyHeights) {
    std::vector<world::Heights> all(std::begin(kSomeHeights), std::end(kSomeHeights));
    all.push_back(kTallest);
    for (const world::Heights heights : all) {
        SCOPED_TRACE(world::describe(heights));
        gen::GeneratorBuilder builder("stamps", contentBlocks(), {0, heights});
        const auto number = builder.field<gen::Int>("number"), base = builder.field<gen::Int>("base");
        for (const gen::VoxelShape& shape : gen::stampShapes()) builder.shape(shape);
        builder.pass2D("feet", [&](gen::Pass& p) {
            const gen::Float where = p.random2D("where", p.x(), p.y());
            const auto layers = static_cast<float>(heights.layers() + 200);
            p.set(number, select(where < 0.2f, gen::Int(where * 25.0f), gen::Int(-1)));
            const gen::Int within =
                gen::Int(p.random2D("base", p.x(), p.y()) * layers) + (heights.bottom - 100);
            const gen::Int beyond = select(where < 0.01f, gen::Int(INT32_MAX), gen::Int(INT32_MIN));
            p.set(base, select(where < 0.02f, beyond, within));
        });
        builder.pass3D("stamps", [&](gen::Pass& p) { p.setBlock(p.stamp(number, base)); });
        const auto graph = builder.finish();
        ASSERT_TRUE(graph) << graph.error().message;
        compare(*graph, gen::chunksInSquare({-1, 4}, 2), 4);
        if (HasFatalFailure()) return;
    }
}

// A batch has as many chunks as fit into the results; slots for blocks are fewer than those for fields.
TEST_F(GpuGeneratorTest, BuiltInGeneratorsEqualCpuInTheTallestWorld) {
    compare("flat", gen::chunksInSquare({-2, -2}, atDepth(5, 9)), 64, kTallest);
    compare("overworld", gen::chunksInSquare({-5, -5}, 1), 4, kTallest);
    for (const std::string& name : gen::namesOf(gen::builtInGenerators()))
        compare(name, gen::chunksInSquare({226, -122}, 1), 1, {-128, 384});
}

// Blocks of neighbors whose slots others have taken meanwhile are made again.
TEST_F(GpuGeneratorTest, BlocksThatWereReplacedAreMadeAgain) {
    using namespace gen;
    GeneratorBuilder builder("far reads", contentBlocks(), {0, kTallest});
    const auto height = builder.field<Float>("height");
    builder.pass2D("land", [&](Pass& p) { p.set(height, p.perlin2D("land", 40, {500.0f, 900.0f})); });
    builder.pass3D("ground", [&](Pass& p) {
        p.setBlock(select(Float(p.z()) < p.read(height), p.block("stone"), p.block("air")));
    });
    builder.pass3D("reads", [&](Pass& p) {
        p.setBlock(
            select(p.blockAt({16, -3}, p.z() - 100) == p.block("air"), p.block("dirt"), p.blockHere()));
    });
    const auto graph = builder.finish();
    ASSERT_TRUE(graph) << graph.error().message;
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < 14; ++k) chunks.push_back({(k % 7) * 2, 0});
    compare(*graph, chunks, 2);
}

TEST_F(GpuGeneratorTest, ManyStampsEqualCpu) {
    for (const auto& write : {std::function<void(gen::GeneratorBuilder&)>([](auto& g) {
                                  gen::writeStamps(g, {700}, {300, 1000});
                              }),
                              std::function<void(gen::GeneratorBuilder&)>(gen::writeStampsAtTheEnds)}) {
        gen::GeneratorBuilder builder("stamps", contentBlocks());
        write(builder);
        const auto graph = builder.finish();
        ASSERT_TRUE(graph) << graph.error().message;
        compare(*graph, gen::chunksInSquare({5, -9}, 1), 1);
    }
}

// Each pass reads around what the one before made: 27×27 chunks for one, more than there are slots.
TEST_F(GpuGeneratorTest, AGeneratorThatTheSlotsCannotHoldIsRefused) {
    using namespace gen;
    GeneratorBuilder builder("wide", contentBlocks());
    std::vector<Field<Int>> fields = {builder.field<Int>("0")};
    builder.pass2D("0", [&](Pass& p) { p.set(fields[0], p.x()); });
    for (int k = 1; k <= 13; ++k) {
        fields.push_back(builder.field<Int>(std::to_string(k)));
        const auto before = fields[static_cast<std::size_t>(k) - 1];
        builder.pass2D(std::to_string(k), [&](Pass& p) { p.set(fields.back(), p.readAt(before, {16, 16})); });
    }
    builder.pass3D("last", [&](Pass& p) { p.setBlock(Block(p.read(fields.back()))); });
    const auto graph = builder.finish();
    ASSERT_TRUE(graph) << graph.error().message;
    const auto refused = GpuGenerator::create(render::contentShaders(), *graph, kSeed);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(
        refused.error().message.starts_with("generator \"wide\": a chunk needs results of 729 chunks"))
        << refused.error().message;
}

TEST_F(GpuGeneratorTest, OverworldEqualsCpuAroundTheOrigin) {
    compare("overworld", gen::chunksInSquare({-5, -5}, atDepth(4, 10)), 50);
}

TEST_F(GpuGeneratorTest, OverworldEqualsCpuFarAway) {
    const int side = atDepth(2, 5);
    compare("overworld", gen::chunksInSquare({100000, -70000}, side), 36);
    compare("overworld", gen::chunksInSquare({world::kMinChunk, world::kMinChunk}, side), 25);
    compare("overworld",
            gen::chunksInSquare({world::kMaxChunk - side + 1, world::kMaxChunk - side + 1}, side), 25);
    compare("overworld", gen::chunksInSquare({world::kMinChunk, world::kMaxChunk - side + 1}, side), 25);
}

// Mountains, canyons, and corners of the world, ±2^31 blocks away.
TEST_F(GpuGeneratorTest, ContinentsEqualCpu) {
    compare("continents", gen::chunksInSquare({226, -122}, atDepth(2, 4)), 16);
    compare("continents", gen::chunksInSquare({-158, 160}, atDepth(2, 3)), 9);
    compare("continents", gen::chunksInSquare({world::kMinChunk, world::kMaxChunk - 1}, 2), 4);
    compare("continents", gen::chunksInSquare({world::kMaxChunk - 1, world::kMinChunk}, 2), 4);
}

TEST_F(GpuGeneratorTest, LevelsEqualCpu) {
    for (const std::string& name : gen::namesOf(gen::builtInGenerators())) {
        for (const std::uint8_t level :
             testsAll() ? std::vector<std::uint8_t>{1, 3, 10, 15} : std::vector<std::uint8_t>{1, 10}) {
            std::vector<ChunkPos> chunks = gen::chunksInSquare({-1, -1, level}, 2);
            chunks.push_back({world::kMinChunk >> level, world::kMaxChunk >> level, level});
            chunks.push_back({world::kMaxChunk >> level, world::kMinChunk >> level, level});
            compare(name, chunks, chunks.size());
        }
    }
}

TEST_F(GpuGeneratorTest, ALevelRefusesOthers) {
    const auto graph = gen::makeGenerator("flat", contentBlocks(), 2);
    ASSERT_TRUE(graph) << graph.error().message;
    auto batches = GpuGenerator::create(render::contentShaders(), *graph, kSeed);
    ASSERT_TRUE(batches) << batches.error().message;
    EXPECT_EQ(batches->level(), 2);
    const std::vector<ChunkPos> others = {{0, 0, 1}};
    EXPECT_THROW(static_cast<void>(batches->submit(others)), std::invalid_argument);
    EXPECT_EQ(generateAll(*batches, others).error().message,
              "chunk 0,0 of level 1: this generator makes level 2 only");
}

TEST_F(GpuGeneratorTest, ScatteredChunksReuseSlots) {
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < atDepth(72, 128); ++k)
        chunks.push_back({(k * 7919) % 1000 - 500, (k * 104729) % 1000 - 500});
    compare("overworld", chunks, kMaxBatch);
}

}  // namespace
}  // namespace terrane::gen_gpu
