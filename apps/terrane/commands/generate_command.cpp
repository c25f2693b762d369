// terrane generate: generates an area, for its digest or its speed.
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/progress_bar.h"
#include "apps/terrane/world_session.h"
#include "terrane/base/digest.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

struct GenerateOptions {
    WorldOptions world;
    std::optional<int> radius;
    std::optional<Area> area;
    bool digest = false;
    bool json = false;
};

// Chunks generated at once: enough for all workers, 64 × about 10 KiB.
constexpr std::int64_t kBatch = 64;

void addToDigest(base::Digest& digest, const world::Chunk& chunk) {
    std::array<world::Section::Value, world::kBlocksPerSection> values;
    for (int s = 0; s < world::kSectionsPerChunk; ++s) {
        chunk.section(s).unpack(values);
        digest.update(std::as_bytes(std::span(values)));
    }
}

// `helpers`: null for one thread. The digest takes chunks by y, then x; blocks by z, y, x, as 16-bit
// little-endian ids.
base::Result<std::string> generateArea(const gen::Generator& generator, const Area& area,
                                       base::JobSystem* helpers, bool wantsDigest) {
    base::Digest digest;
    ProgressBar bar("generating", static_cast<std::size_t>(area.chunkCount()));
    const std::int64_t width = std::int64_t{area.x1} - area.x0;
    std::vector<world::Chunk> chunks(kBatch);
    for (std::int64_t first = 0; first < area.chunkCount(); first += kBatch) {
        const auto count = static_cast<std::size_t>(std::min(kBatch, area.chunkCount() - first));
        const auto generateOne = [&](std::size_t k) {
            const std::int64_t n = first + static_cast<std::int64_t>(k);
            chunks[k] = generator.generate({static_cast<std::int32_t>(area.x0 + n % width),
                                            static_cast<std::int32_t>(area.y0 + n / width)});
        };
        if (helpers) {
            auto done = base::parallelFor(*helpers, count, generateOne);
            if (!done) return tl::unexpected(done.error());
        } else {
            for (std::size_t k = 0; k < count; ++k) generateOne(k);
        }
        for (std::size_t k = 0; wantsDigest && k < count; ++k) addToDigest(digest, chunks[k]);
        bar.set(static_cast<std::size_t>(first) + count);
    }
    return digest.hex();
}

base::Result<void> generate(const GenerateOptions& options) {
    if (!options.area && !options.radius) return base::fail("generate needs --radius or --area");
    const int r = options.radius.value_or(0);
    const Area area = options.area.value_or(Area{-r, -r, r + 1, r + 1});
    auto blocks = loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto generator = makeGenerator(options.world, *blocks);
    if (!generator) return tl::unexpected(generator.error());

    // The calling thread works too, so one worker less.
    const unsigned threads = threadCount(options.world);
    std::optional<base::JobSystem> helpers;
    if (threads > 1) helpers.emplace(threads - 1);
    const auto start = std::chrono::steady_clock::now();
    auto digest = generateArea(*generator, area, helpers ? &*helpers : nullptr, options.digest);
    if (!digest) return tl::unexpected(digest.error());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double speed = static_cast<double>(area.chunkCount()) / seconds;

    base::logInfo("{} chunks in {:.2f} s, {:.0f} chunks/s, threads: {}", area.chunkCount(), seconds, speed,
                  threads);
    if (options.json) {
        nlohmann::json result = {{"chunks", area.chunkCount()},
                                 {"seconds", seconds},
                                 {"chunks_per_second", speed},
                                 {"threads", threads},
                                 {"backend", "cpu"}};
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
                       ->check(CLI::Range(0, 4096));
    addAreaOption(*command, options->area);
    command->get_option("--area")->excludes(radius);
    command->add_flag("--digest", options->digest, "Print one hash over all blocks");
    command->add_flag("--json", options->json, "Print the result as JSON");
    addWorldOptions(*command, options->world);
    return {command, [options] { return generate(*options); }};
}

}  // namespace terrane::app
