// terrane generate: generates an area, for its digest or its speed.
#include <fmt/ranges.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/batch_generator.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/progress_bar.h"
#include "apps/terrane/world_session.h"
#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/glsl_emitter.h"
#include "terrane/gen/kernels.h"

namespace terrane::app {
namespace {

struct GenerateOptions {
    WorldOptions world;
    std::optional<int> radius;
    std::optional<Area> area;
    bool digest = false;
    bool json = false;
    bool explain = false;
    Backend backend = Backend::Auto;
    std::string simd;
};

// Chunks generated at once: enough for all workers or three batches of the GPU, 192 × about 10 KiB.
constexpr std::int64_t kBatch = 192;

void addToDigest(base::Digest& digest, const world::Chunk& chunk) {
    std::array<world::Section::Value, world::kBlocksPerSection> values;
    for (int s = 0; s < world::kSectionsPerChunk; ++s) {
        chunk.section(s).unpack(values);
        digest.update(std::as_bytes(std::span(values)));
    }
}

// The digest takes chunks by y, then x; blocks by z, y, x, as 16-bit little-endian ids.
base::Result<std::string> generateArea(BatchGenerator& generator, const Area& area, bool wantsDigest) {
    base::Digest digest;
    ProgressBar bar("generating", static_cast<std::size_t>(area.chunkCount()));
    const std::int64_t width = std::int64_t{area.x1} - area.x0;
    std::vector<world::Chunk> chunks(kBatch);
    std::vector<world::ChunkPos> positions;
    for (std::int64_t first = 0; first < area.chunkCount(); first += kBatch) {
        positions.clear();
        for (std::int64_t n = first; n < std::min(first + kBatch, area.chunkCount()); ++n) {
            positions.push_back({static_cast<std::int32_t>(area.x0 + n % width),
                                 static_cast<std::int32_t>(area.y0 + n / width)});
        }
        auto done = generator.generate(positions, chunks);
        if (!done) return tl::unexpected(done.error());
        for (std::size_t k = 0; wantsDigest && k < positions.size(); ++k) addToDigest(digest, chunks[k]);
        bar.set(static_cast<std::size_t>(first) + positions.size());
    }
    return digest.hex();
}

// The passes, what they read and write, and their GLSL.
base::Result<void> explain(const WorldOptions& options, const world::BlockRegistry& blocks) {
    auto graph = gen::makeGenerator(options.generator, blocks);
    if (!graph) return tl::unexpected(graph.error());
    for (std::size_t k = 0; k < graph->passes.size(); ++k) {
        const gen::PassGraph& pass = graph->passes[k];
        fmt::print("// pass {}: {}, {}, {} nodes\n", k, pass.name, pass.is3D ? "3D" : "2D",
                   pass.graph.size());
        for (const gen::FieldOutput& f : pass.fields)
            fmt::print("// writes field {}\n", graph->fields[f.field].name);
        for (const std::uint32_t f : pass.readsAt)
            fmt::print("// reads around field {}\n", graph->fields[f].name);
        fmt::print("{}\n", gen::emitGlsl(*graph, k));
    }
    return {};
}

base::Result<void> generate(const GenerateOptions& options) {
    if (!options.area && !options.radius && !options.explain) {
        return base::fail("generate needs --radius, --area or --explain");
    }
    const int r = options.radius.value_or(0);
    const Area area = options.area.value_or(Area{-r, -r, r + 1, r + 1});
    auto blocks = loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    if (options.explain) return explain(options.world, *blocks);
    if (!gen::chooseSimdTarget(options.simd)) {
        return base::fail("--simd: this machine has no {}, but {}", options.simd,
                          fmt::join(gen::simdTargets(), ", "));
    }
    auto generator = makeBatchGenerator(options.world, options.backend, *blocks);
    if (!generator) return tl::unexpected(generator.error());

    const auto start = std::chrono::steady_clock::now();
    auto digest = generateArea(**generator, area, options.digest);
    if (!digest) return tl::unexpected(digest.error());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double speed = static_cast<double>(area.chunkCount()) / seconds;

    const unsigned threads = threadCount(options.world);
    base::logInfo("{} chunks in {:.2f} s, {:.0f} chunks/s, back end {}, threads {}", area.chunkCount(),
                  seconds, speed, (*generator)->backend(), threads);
    if (options.json) {
        nlohmann::json result = {{"chunks", area.chunkCount()},
                                 {"seconds", seconds},
                                 {"chunks_per_second", speed},
                                 {"threads", threads},
                                 {"backend", (*generator)->backend()}};
        if (options.digest) result["digest"] = *digest;
        std::cout << result.dump() << '\n';
    } else if (options.digest) {
        std::cout << *digest << '\n';
    }
    return {};
}

}  // namespace

CommandEntry addGenerate(CLI::App& app) {
    auto options = std::make_shared<GenerateOptions>();
    CLI::App* command = app.add_subcommand("generate", "Generate an area of the world");
    auto* radius = command->add_option("--radius", options->radius, "Chunks around 0,0: (2R+1)² of them")
                       ->check(numberFrom(0, 4096));
    addAreaOption(*command, options->area);
    command->get_option("--area")->excludes(radius);
    command->add_flag("--digest", options->digest, "Print one hash over all blocks");
    command->add_flag("--json", options->json, "Print the result as JSON");
    command->add_flag("--explain", options->explain, "Print the generator's passes and their GLSL instead");
    addBackendOption(*command, options->backend);
    command->add_option("--simd", options->simd, "Instruction set, as info lists them (default: the best)");
    addWorldOptions(*command, options->world);
    return {command, [options] { return generate(*options); }};
}

}  // namespace terrane::app
