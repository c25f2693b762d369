#include "terrane/light/light_solver.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "terrane/world/coords.h"

namespace terrane::light {
namespace {

constexpr int kMaxLevel = 15;
constexpr int kDaylight = 3;  // component

class Solver {
  public:
    Solver(const LightArea& area, const world::BlockRegistry& blocks)
        : width_(area.chunksX * world::kChunkSize),
          height_(area.chunksY * world::kChunkSize),
          layer_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)),
          opacity_(layer_ * world::kChunkHeight),
          light_(layer_ * world::kChunkHeight) {
        assert(area.chunks.size() ==
               static_cast<std::size_t>(area.chunksX) * static_cast<std::size_t>(area.chunksY));
        for (int cy = 0; cy < area.chunksY; ++cy) {
            for (int cx = 0; cx < area.chunksX; ++cx) {
                readChunk(*area.chunks[static_cast<std::size_t>(cx + area.chunksX * cy)], blocks, cx, cy);
            }
        }
    }

    std::vector<LightValue> run() {
        shineDown();
        for (int component = 0; component <= kDaylight; ++component) spread(component);
        return std::move(light_);
    }

  private:
    void readChunk(const world::Chunk& chunk, const world::BlockRegistry& blocks, int cx, int cy) {
        for (int k = 0; k < world::kBlocksPerChunk; ++k) {
            const world::BlockType& type = blocks.type(chunk.block(static_cast<world::BlockIndex>(k)));
            const int x = cx * world::kChunkSize + (k & 15), y = cy * world::kChunkSize + ((k >> 4) & 15);
            const std::size_t at = index(x, y, k >> 8);
            opacity_[at] = type.opacity;
            const auto& e = type.emission;
            light_[at] = static_cast<LightValue>(e[0] | e[1] << 4 | e[2] << 8);
        }
    }

    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x) + static_cast<std::size_t>(width_) * static_cast<std::size_t>(y) +
               layer_ * static_cast<std::size_t>(z);
    }

    void shineDown() {
        for (std::size_t column = 0; column < layer_; ++column) {
            int level = kMaxLevel;
            for (int z = world::kChunkHeight - 1; z >= 0 && level > 0; --z) {
                const std::size_t at = column + layer_ * static_cast<std::size_t>(z);
                level = std::max(0, level - opacity_[at]);
                light_[at] = static_cast<LightValue>(light_[at] | level << 12);
            }
        }
    }

    // From the brightest level down, so that each voxel is settled when its bucket is reached.
    void spread(int component) {
        const int shift = 4 * component;
        std::array<std::vector<std::size_t>, kMaxLevel + 1> buckets;
        for (std::size_t at = 0; at < light_.size(); ++at) {
            const int level = light_[at] >> shift & 15;
            if (level > 1) buckets[static_cast<std::size_t>(level)].push_back(at);
        }
        for (int level = kMaxLevel; level > 1; --level) {
            for (const std::size_t at : buckets[static_cast<std::size_t>(level)]) {
                if ((light_[at] >> shift & 15) != level) continue;  // raised since
                forEachNeighbour(at, [&](std::size_t next) {
                    const int reached = level - 1 - opacity_[next];
                    if (reached <= (light_[next] >> shift & 15)) return;
                    light_[next] =
                        static_cast<LightValue>((light_[next] & ~(15 << shift)) | reached << shift);
                    if (reached > 1) buckets[static_cast<std::size_t>(reached)].push_back(next);
                });
            }
        }
    }

    template <class Function>
    void forEachNeighbour(std::size_t at, Function f) const {
        const auto width = static_cast<std::size_t>(width_);
        const std::size_t x = at % width, y = at / width % static_cast<std::size_t>(height_);
        if (x > 0) f(at - 1);
        if (x + 1 < width) f(at + 1);
        if (y > 0) f(at - width);
        if (y + 1 < static_cast<std::size_t>(height_)) f(at + width);
        if (at >= layer_) f(at - layer_);
        if (at + layer_ < light_.size()) f(at + layer_);
    }

    int width_, height_;
    std::size_t layer_;
    std::vector<std::uint8_t> opacity_;
    std::vector<LightValue> light_;
};

}  // namespace

std::vector<LightValue> solveLight(const LightArea& area, const world::BlockRegistry& blocks) {
    return Solver(area, blocks).run();
}

}  // namespace terrane::light
