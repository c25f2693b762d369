#include "terrane/game/spawn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "terrane/world/character.h"

namespace terrane::game {
namespace {

constexpr int kMiddle = world::kChunkSize / 2;
constexpr int kRings = 7, kSpacing = 6;  // chunks between candidates

int highest(const world::Chunk& chunk, const world::BlockRegistry& blocks, int x, int y) {
    for (int z = world::kChunkHeight - 1; z >= 0; --z) {
        const world::BlockType& type = blocks.type(chunk.block(world::blockIndex(x, y, z)));
        if (!type.collision.empty() || type.shape == world::Shape::Liquid) return z;
    }
    return -1;
}

// Whether a block is ground to stand on.
using IsGround = std::function<bool(const world::BlockType&)>;

// The height to stand at; none if it is wet, steep or under trees.
std::optional<int> pleasantHeight(const world::Chunk& chunk, const world::BlockRegistry& blocks,
                                  const IsGround& isGround) {
    int least = world::kChunkHeight, most = -1;
    for (int y = 3; y < 13; ++y) {
        for (int x = 3; x < 13; ++x) {
            const int z = highest(chunk, blocks, x, y);
            if (z < 0) return std::nullopt;
            if (!isGround(blocks.type(chunk.block(world::blockIndex(x, y, z))))) return std::nullopt;
            least = std::min(least, z);
            most = std::max(most, z);
        }
    }
    const int here = highest(chunk, blocks, kMiddle, kMiddle);
    return most - least <= 3 ? std::optional(here) : std::nullopt;
}

// The yaw toward the highest land around.
float viewFrom(const gen::Generator& generator, const world::BlockRegistry& blocks, world::ChunkPos pos) {
    constexpr int kDirections = 12, kDistance = 9;  // chunks
    float best = 0;
    int bestHeight = -1;
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * std::numbers::pi * k / kDirections;
        const world::ChunkPos at =
            world::offsetBy(pos, static_cast<int>(std::lround(kDistance * std::cos(angle))),
                            static_cast<int>(std::lround(kDistance * std::sin(angle))));
        const int height = highest(generator.generate(at), blocks, kMiddle, kMiddle);
        if (height <= bestHeight) continue;
        bestHeight = height;
        best = 360.0f * static_cast<float>(k) / kDirections;
    }
    return best;
}

world::Pose standingAt(world::ChunkPos pos, int ground, float yaw) {
    return {
        {pos.x * 16 + kMiddle + 0.5, pos.y * 16 + kMiddle + 0.5, ground + 1 + world::kEyeHeight}, yaw, -4};
}

std::optional<world::Pose> findPleasant(const gen::Generator& generator, const world::BlockRegistry& blocks,
                                        const IsGround& isGround) {
    for (int ring = 0; ring <= kRings; ++ring) {
        for (int y = -ring; y <= ring; ++y) {
            for (int x = -ring; x <= ring; ++x) {
                if (std::max(std::abs(x), std::abs(y)) != ring) continue;
                const world::ChunkPos pos{x * kSpacing, y * kSpacing};
                const auto ground = pleasantHeight(generator.generate(pos), blocks, isGround);
                if (ground) return standingAt(pos, *ground, viewFrom(generator, blocks, pos));
            }
        }
    }
    return std::nullopt;
}

}  // namespace

world::Pose findSpawn(const gen::Generator& generator, const world::BlockRegistry& blocks) {
    const auto isGrass = [](const world::BlockType& type) { return type.name == "grass"; };
    const auto isFirm = [](const world::BlockType& type) { return type.opaqueCube; };
    if (const auto meadow = findPleasant(generator, blocks, isGrass)) return *meadow;
    if (const auto dry = findPleasant(generator, blocks, isFirm)) return *dry;
    const int ground = highest(generator.generate({}), blocks, kMiddle, kMiddle);
    return standingAt({}, std::min(std::max(ground, 0), world::kChunkHeight - 1), 0);
}

std::optional<world::Pose> poseOnSurface(const world::World& world, const world::BlockRegistry& blocks,
                                         const world::Pose& pose) {
    if (pose.position.z >= 0) return std::nullopt;
    const world::BlockPos at = world::blockOf(pose.position);
    const world::ChunkPtr chunk = world.maybeChunkAt(world::chunkOf(pose.position));
    const int ground = chunk ? highest(*chunk, blocks, at.x & 15, at.y & 15) : -1;
    if (ground < 0) return std::nullopt;
    world::Pose lifted = pose;
    lifted.position.z = ground + 1 + world::kEyeHeight;
    return lifted;
}

}  // namespace terrane::game
