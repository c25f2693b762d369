// A session on flat ground of stone, 64 blocks high, kept in memory.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "terrane/game/session.h"
#include "terrane/gen/language/builder.h"
#include "terrane/store/overlay_store.h"
#include "tests/world/content_blocks.h"

namespace terrane::game {

constexpr int kGroundHeight = 64;

inline gen::LevelGenerators flatGenerators() {
    const auto makeGraph = [](int level) {
        gen::GeneratorBuilder builder("flat stone", contentBlocks(), level);
        builder.pass3D("ground", [](gen::Pass& p) {
            p.setBlock(select(p.z() < kGroundHeight, p.block("stone"), p.block("air")));
        });
        return builder.finish();
    };
    return {makeGraph, 1};
}

inline SessionParts flatParts() {
    const store::WorldIdentity identity{.seed = 1, .generator = "flat stone", .generatorVersion = 1};
    return {std::make_unique<const world::BlockRegistry>(contentBlocks()), flatGenerators(),
            std::make_unique<store::MemoryStore>(identity), 2};
}

class SessionTest : public testing::Test {
  protected:
    SessionTest() { load(2); }

    // Updates until all chunks up to `distance` around the chunk are lit and meshed.
    void load(int distance, world::ChunkPos center = {0, 0}) {
        session_.pipeline().setView(center, distance);
        settle();
    }
    void settle() {
        stream::ChunkPipeline& pipeline = session_.pipeline();
        for (pipeline.update(); !pipeline.progress().isUpToDate(); pipeline.update()) {
            pipeline.waitForWorkers(std::chrono::milliseconds(100));
        }
    }
    std::vector<stream::ChunkChange> takeChanges() {
        return session_.pipeline().takeChanges(std::numeric_limits<std::size_t>::max());
    }

    Session session_{flatParts()};
};

}  // namespace terrane::game
