// The chunks of a reference scene, for the benchmarks of light.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/base/job_system.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/light/chunk_light.h"
#include "tests/support/default_heights.h"

namespace terrane::bench {

constexpr int kViewDistance = 16;
constexpr int kSide = 2 * kViewDistance + 3;  // chunks along x and y, one around those that are lit

// Chunks of the scene with one around them, x fastest.
inline std::vector<world::Chunk> sceneChunks(std::string_view name) {
    const world::ChunkPos center = world::chunkOf(content::findScene(name)->pose.position);
    const gen::Generator generator(orExit(gen::makeGenerator("overworld", blocks())), 1);
    std::vector<world::Chunk> chunks(kSide * kSide);
    base::JobSystem jobs(2);
    const auto done = base::parallelFor(jobs, chunks.size(), [&](std::size_t k) {
        chunks[k] = generator.generate({center.x - kViewDistance - 1 + static_cast<int>(k) % kSide,
                                        center.y - kViewDistance - 1 + static_cast<int>(k) / kSide});
    });
    if (!done) std::exit(1);
    return chunks;
}

inline std::string digestOf(const std::vector<light::ChunkLight>& lights) {
    base::Digest digest;
    std::vector<light::LightValue> values(world::kBlocksPerSection);
    for (const light::ChunkLight& chunk : lights) {
        for (int s = 0; s < world::kSectionsPerChunk; ++s) {
            chunk.brick(s).unpack(std::span(values).first<world::kBlocksPerSection>());
            digest.update(std::as_bytes(std::span(values)));
        }
    }
    return digest.hex();
}

}  // namespace terrane::bench
