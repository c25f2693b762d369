#include "terrane/game/spawn.h"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <unordered_map>

namespace terrane::game {
namespace {

constexpr int kMiddle = world::kChunkSize / 2;
constexpr int kRings = 7, kSpacing = 6;  // chunks between candidates

// Of a block that hides the view; below the world if there is none.
int highest(const world::Chunk& chunk, const world::BlockRegistry& blocks, int x, int y) {
    const world::Heights heights = chunk.heights();
    int z = heights.top - 1;
    for (; z >= heights.bottom; --z) {
        const world::BlockType& type = blocks.type(chunk.block(world::blockIndex(x, y, z)));
        if (!type.collision.empty() || type.shape == world::Shape::Liquid) break;
    }
    return z;
}

// Whether a block is ground to stand on.
using IsGround = std::function<bool(const world::BlockType&)>;

// The height to stand at; none if it is wet, steep or under trees.
std::optional<int> pleasantHeight(const world::Chunk& chunk, const world::BlockRegistry& blocks,
                                  const IsGround& isGround) {
    const world::Heights heights = chunk.heights();
    int least = heights.top, most = heights.bottom - 1;
    for (int y = 3; y < 13; ++y) {
        for (int x = 3; x < 13; ++x) {
            const int z = highest(chunk, blocks, x, y);
            if (z < heights.bottom) return std::nullopt;
            if (!isGround(blocks.type(chunk.block(world::blockIndex(x, y, z))))) return std::nullopt;
            least = std::min(least, z);
            most = std::max(most, z);
        }
    }
    const int here = highest(chunk, blocks, kMiddle, kMiddle);
    return most - least <= 3 ? std::optional(here) : std::nullopt;
}

// Reads heights of generated columns, each chunk once.
class ColumnHeights {
  public:
    ColumnHeights(const gen::Generator& generator, const world::BlockRegistry& blocks)
        : generator_(generator), blocks_(blocks) {}

    // Of the highest block that hides the view; `x`, `y` in blocks.
    int at(double x, double y) {
        const world::BlockPos column = world::blockOf({x, y, 0});
        const world::ChunkPos pos = world::chunkOf(column);
        auto found = chunks_.find(pos);
        if (found == chunks_.end()) found = chunks_.emplace(pos, generator_.generate(pos)).first;
        return highest(found->second, blocks_, column.x & 15, column.y & 15);
    }

  private:
    const gen::Generator& generator_;
    const world::BlockRegistry& blocks_;
    std::unordered_map<world::ChunkPos, world::Chunk, world::ChunkPosHash> chunks_;
};

struct View {
    float yaw;
    double
        horizon;  // the largest slope from the eye to a column, a mean of that direction and those beside it
};

// The most open view: of 16 directions the one whose horizon is lowest, with those beside it, which are on
// the screen too.
View viewFrom(const gen::Generator& generator, const world::BlockRegistry& blocks, const glm::dvec3& eye) {
    constexpr int kDirections = 16;
    constexpr std::array<double, 8> kDistances = {3, 6, 10, 16, 28, 48, 80, 136};  // blocks
    ColumnHeights heights(generator, blocks);
    std::array<double, kDirections> horizon{};  // the largest slope from the eye to a column
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * std::numbers::pi * k / kDirections;
        double& slope = horizon[static_cast<std::size_t>(k)];
        slope = -std::numeric_limits<double>::max();
        for (const double distance : kDistances) {
            const int top =
                heights.at(eye.x + distance * std::cos(angle), eye.y + distance * std::sin(angle));
            slope = std::max(slope, (top + 1 - eye.z) / distance);
        }
    }
    const auto sumAround = [&](int k) {
        const auto at = [&](int direction) {
            return horizon[static_cast<std::size_t>((direction + kDirections) % kDirections)];
        };
        return 2 * at(k) + at(k - 1) + at(k + 1);
    };
    int best = 0;
    for (int k = 1; k < kDirections; ++k)
        if (sumAround(k) < sumAround(best)) best = k;
    return {360.0f * static_cast<float>(best) / kDirections, sumAround(best) / 4};
}

world::Pose standingAt(world::ChunkPos pos, int ground) {
    return {{pos.x * 16 + kMiddle + 0.5, pos.y * 16 + kMiddle + 0.5, ground + 1 + world::kEyeHeight}, 0, -4};
}

constexpr double kOpenHorizon = 0.05;  // slope: higher ground hides the land behind it

// The first pleasant place of a ring of candidates.
std::optional<world::Pose> findInRing(const gen::Generator& generator, const world::BlockRegistry& blocks,
                                      const IsGround& isGround, int ring) {
    for (int y = -ring; y <= ring; ++y) {
        for (int x = -ring; x <= ring; ++x) {
            if (std::max(std::abs(x), std::abs(y)) != ring) continue;
            const world::ChunkPos pos{x * kSpacing, y * kSpacing};
            const auto ground = pleasantHeight(generator.generate(pos), blocks, isGround);
            if (ground) return standingAt(pos, *ground);
        }
    }
    return std::nullopt;
}

// The first place with an open view, else the one with the lowest horizon. A view costs some hundred chunks,
// and places beside each other have much the same: one of each ring is tried.
std::optional<world::Pose> findPleasant(const gen::Generator& generator, const world::BlockRegistry& blocks,
                                        const IsGround& isGround) {
    std::optional<world::Pose> best;
    double lowest = std::numeric_limits<double>::max();
    for (int ring = 0; ring <= kRings && lowest > kOpenHorizon; ++ring) {
        std::optional<world::Pose> place = findInRing(generator, blocks, isGround, ring);
        if (!place) continue;
        const View view = viewFrom(generator, blocks, place->position);
        place->yaw = view.yaw;
        if (view.horizon < lowest) best = place;
        lowest = std::min(lowest, view.horizon);
    }
    return best;
}

}  // namespace

world::Pose findSpawn(const gen::Generator& generator, const world::BlockRegistry& blocks) {
    const auto isGrass = [](const world::BlockType& type) { return type.name == "grass"; };
    const auto isFirm = [](const world::BlockType& type) { return type.opaqueCube; };
    std::optional<world::Pose> place = findPleasant(generator, blocks, isGrass);
    if (!place) place = findPleasant(generator, blocks, isFirm);
    if (!place) {
        const int ground = highest(generator.generate({}), blocks, kMiddle, kMiddle);
        place = standingAt({}, generator.heights().clamp(ground));
        place->yaw = viewFrom(generator, blocks, place->position).yaw;
    }
    return *place;
}

namespace {

// The chunks of a session as they are now, each read once: loaded, stored or generated.
class ChunksNow {
  public:
    explicit ChunksNow(Session& session) : session_(session) {}

    const world::BlockType& typeAt(world::BlockPos pos) {
        const world::ChunkPos at = world::chunkOf(pos);
        auto found = chunks_.find(at);
        if (found == chunks_.end()) found = chunks_.emplace(at, read(at)).first;
        return session_.blocks().type(found->second->block(world::blockIndex(pos)));
    }

    world::Heights heights() const { return session_.world().heights(); }

  private:
    world::ChunkPtr read(world::ChunkPos pos) {
        if (world::ChunkPtr loaded = session_.world().maybeChunkAt(pos)) return loaded;
        if (world::ChunkPtr stored = session_.store().load(pos).chunk) return stored;
        return std::make_shared<const world::Chunk>(session_.generator().generate(pos));
    }

    Session& session_;
    std::unordered_map<world::ChunkPos, world::ChunkPtr, world::ChunkPosHash> chunks_;
};

bool isFree(const world::BlockType& type) {
    return type.collision.empty() && type.shape != world::Shape::Liquid;
}

// Whether a body whose feet are in this block stands on firm ground, in nothing.
bool canStandIn(ChunksNow& chunks, world::BlockPos feet) {
    if (!chunks.heights().contains(feet.z - 1) || !chunks.heights().contains(feet.z + 1)) return false;
    return chunks.typeAt({feet.x, feet.y, feet.z - 1}).opaqueCube && isFree(chunks.typeAt(feet)) &&
           isFree(chunks.typeAt({feet.x, feet.y, feet.z + 1}));
}

// The feet of a body in this column: at most one block above or below `feet`.
std::optional<world::BlockPos> onLevel(ChunksNow& chunks, world::BlockPos feet) {
    for (const int step : {0, 1, -1})
        if (canStandIn(chunks, {feet.x, feet.y, feet.z + step}))
            return world::BlockPos{feet.x, feet.y, feet.z + step};
    return std::nullopt;
}

// The feet of a body in this column: under the sky or under leaves.
std::optional<world::BlockPos> onSurface(ChunksNow& chunks, world::BlockPos column) {
    int z = chunks.heights().top - 1;
    while (z > chunks.heights().bottom && !chunks.typeAt({column.x, column.y, z}).opaqueCube) --z;
    const world::BlockPos feet{column.x, column.y, z + 1};
    return canStandIn(chunks, feet) ? std::optional(feet) : std::nullopt;
}

bool overlaps(const world::Aabb& a, const world::Aabb& b) {
    return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

// Calls find(column) for the columns around `middle`, the nearest rings first, until it returns a value.
template <class Find>
std::optional<glm::dvec3> firstAround(world::BlockPos middle, int rings, Find find) {
    constexpr std::int64_t kFirst = std::numeric_limits<std::int32_t>::min(),
                           kLast = std::numeric_limits<std::int32_t>::max();
    for (int ring = 0; ring <= rings; ++ring) {
        for (int dy = -ring; dy <= ring; ++dy) {
            for (int dx = -ring; dx <= ring; ++dx) {
                const std::int64_t x = std::int64_t{middle.x} + dx, y = std::int64_t{middle.y} + dy;
                const bool isInWorld = x >= kFirst && x <= kLast && y >= kFirst && y <= kLast;
                if (std::max(std::abs(dx), std::abs(dy)) != ring || !isInWorld) continue;
                const auto found = find(
                    world::BlockPos{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), middle.z});
                if (found) return found;
            }
        }
    }
    return std::nullopt;
}

}  // namespace

world::Pose freePlaceNear(const world::Pose& spawn, Session& session, std::span<const world::Aabb> taken) {
    // 9 × 9 columns on the spawn's level; 65 × 65 on the surface, in 25 chunks.
    constexpr int kLevelRings = 4, kSurfaceRings = 32;
    ChunksNow chunks(session);
    const auto apart = [&](const glm::dvec3& feet) {
        const world::Aabb body = world::characterBox(feet);
        const bool isTaken =
            std::ranges::any_of(taken, [&](const world::Aabb& other) { return overlaps(body, other); });
        return isTaken ? std::nullopt : std::optional(feet);
    };
    const auto inMiddle = [&](const std::optional<world::BlockPos>& feet) {
        return feet ? apart({feet->x + 0.5, feet->y + 0.5, feet->z}) : std::nullopt;
    };
    const glm::dvec3 feet = spawn.position - glm::dvec3(0, 0, world::kEyeHeight);
    // The feet stand on a face between two blocks: rounding may not put them into the lower one.
    const world::BlockPos middle = world::blockOf(feet + glm::dvec3(0, 0, 0.01));
    std::optional<glm::dvec3> place = firstAround(
        middle, kLevelRings, [&](world::BlockPos column) { return inMiddle(onLevel(chunks, column)); });
    if (!place) {
        place = firstAround(middle, kSurfaceRings,
                            [&](world::BlockPos column) { return inMiddle(onSurface(chunks, column)); });
    }
    if (!place) {
        place = firstAround(middle, kSurfaceRings, [&](world::BlockPos column) {
            return apart({column.x + 0.5, column.y + 0.5, feet.z});
        });
    }
    world::Pose pose = spawn;
    if (place) pose.position = *place + glm::dvec3(0, 0, world::kEyeHeight);
    return pose;
}

std::optional<world::Pose> poseOnSurface(const world::World& world, const world::BlockRegistry& blocks,
                                         const world::Pose& pose) {
    const int bottom = world.heights().bottom;
    if (pose.position.z >= bottom) return std::nullopt;
    const world::BlockPos at = world::blockOf(pose.position);
    const world::ChunkPtr chunk = world.maybeChunkAt(world::chunkOf(pose.position));
    const int ground = chunk ? highest(*chunk, blocks, at.x & 15, at.y & 15) : bottom - 1;
    if (ground < bottom) return std::nullopt;
    world::Pose lifted = pose;
    lifted.position.z = ground + 1 + world::kEyeHeight;
    return lifted;
}

}  // namespace terrane::game
