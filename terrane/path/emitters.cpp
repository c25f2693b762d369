#include "terrane/path/emitters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrane::path {
namespace {

constexpr double kNearest = 8;  // blocks: nearer cells count as if they were that far away

std::uint64_t blockKey(world::ChunkPos tile, world::BlockIndex block) {
    const std::uint64_t column = static_cast<std::uint64_t>(
        shared::hash2(static_cast<std::uint32_t>(tile.x), static_cast<std::uint32_t>(tile.y), tile.level));
    return column << 32 | static_cast<std::uint32_t>(block);
}

}  // namespace

std::size_t EmitterTable::KeyHash::operator()(const glm::ivec3& key) const {
    return shared::hash3(static_cast<std::uint32_t>(key.x), static_cast<std::uint32_t>(key.y),
                         static_cast<std::uint32_t>(key.z), 0);
}

glm::ivec3 EmitterTable::keyOf(const glm::dvec3& point) {
    return glm::ivec3(glm::floor(point)) >> kCellBits;
}

EmitterTable::EmitterTable(std::vector<Emitter> emitters) : emitters_(std::move(emitters)) {
    const auto placeOf = [](const Emitter& e) {
        const glm::dvec3 middle = e.corner + 0.5 * glm::dvec3(e.alongU + e.alongV);
        return keyOf(middle);
    };
    const auto less = [&](const Emitter& a, const Emitter& b) {
        const glm::ivec3 x = placeOf(a), y = placeOf(b);
        if (x.z != y.z) return x.z < y.z;
        return x.y != y.y ? x.y < y.y : x.x < y.x;
    };
    std::stable_sort(emitters_.begin(), emitters_.end(), less);
    double sum = 0;
    for (std::uint32_t k = 0; k < emitters_.size(); ++k) {
        const Emitter& emitter = emitters_[k];
        sum += double{emitter.power};
        cumulative_.push_back(sum);
        byBlock_[blockKey(emitter.tile, emitter.block)].push_back(k);
        const glm::ivec3 key = placeOf(emitter);
        const auto [at, isNew] = byPlace_.try_emplace(key, static_cast<std::uint32_t>(cells_.size()));
        if (isNew) {
            cells_.push_back({});
            cells_.back().first = k;
            cells_.back().middle = glm::dvec3(key * (1 << kCellBits) + (1 << (kCellBits - 1)));
        }
        Cell& cell = cells_[at->second];
        ++cell.count;
        cell.power += emitter.power;
    }
    // Cells around those with emitters have none of their own, but neighbors.
    const auto lit = static_cast<std::uint32_t>(cells_.size());
    std::vector<glm::ivec3> keys(lit);
    for (const auto& [key, number] : byPlace_) keys[number] = key;
    for (std::uint32_t number = 0; number < lit; ++number) {
        for (int k = 0; k < 27; ++k) {
            const glm::ivec3 key = keys[number] + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const auto [at, isNew] = byPlace_.try_emplace(key, static_cast<std::uint32_t>(cells_.size()));
            if (isNew) cells_.push_back({});
            Cell& cell = cells_[at->second];
            cell.near[static_cast<std::size_t>(cell.nearCount++)] = number;
        }
    }
}

const EmitterTable::Cell* EmitterTable::cellAt(const glm::dvec3& point) const {
    const auto found = byPlace_.find(keyOf(point));
    return found != byPlace_.end() ? &cells_[found->second] : nullptr;
}

float EmitterTable::weightOf(const Cell& cell, const glm::dvec3& point) {
    const glm::dvec3 away = cell.middle - point;
    return cell.power / static_cast<float>(std::max(glm::dot(away, away), kNearest * kNearest));
}

float EmitterTable::nearWeight(const Cell& around, const glm::dvec3& point) const {
    float sum = 0;
    for (int k = 0; k < around.nearCount; ++k)
        sum += weightOf(cells_[around.near[static_cast<std::size_t>(k)]], point);
    return sum;
}

std::optional<EmitterTable::Choice> EmitterTable::choose(const glm::dvec3& point, Random& random) const {
    if (isEmpty()) return std::nullopt;
    const Cell* around = cellAt(point);
    if (around == nullptr && random.next() >= kChanceFar) return std::nullopt;
    // Among the faces first … end - 1, by their power.
    const auto pick = [&](std::uint32_t first, std::uint32_t end) {
        const double before = first > 0 ? cumulative_[first - 1] : 0;
        const double at = before + double{random.next()} * (cumulative_[end - 1] - before);
        const auto begin = cumulative_.begin();
        const auto found = std::upper_bound(begin + first, begin + end, at) - begin;
        return &emitters_[std::min(static_cast<std::uint32_t>(found), end - 1)];
    };
    const Emitter* chosen = nullptr;
    if (around == nullptr || random.next() < kShareOfAll) {
        chosen = pick(0, static_cast<std::uint32_t>(emitters_.size()));
    } else {
        float left = random.next() * nearWeight(*around, point);
        int k = 0;
        for (; k < around->nearCount - 1; ++k) {
            left -= weightOf(cells_[around->near[static_cast<std::size_t>(k)]], point);
            if (left < 0) break;
        }
        const Cell& cell = cells_[around->near[static_cast<std::size_t>(k)]];
        chosen = pick(cell.first, cell.first + cell.count);
    }
    return Choice{chosen, chanceOf(*chosen, point)};
}

float EmitterTable::chanceOf(const Emitter& emitter, const glm::dvec3& point) const {
    const float ofAll = static_cast<float>(double{emitter.power} / cumulative_.back());
    const Cell* around = cellAt(point);
    if (around == nullptr) return kChanceFar * ofAll;
    const glm::dvec3 middle = emitter.corner + 0.5 * glm::dvec3(emitter.alongU + emitter.alongV);
    const Cell& own = cells_[byPlace_.at(keyOf(middle))];
    float near = 0;
    const glm::ivec3 away = glm::abs(keyOf(middle) - keyOf(point));
    if (std::max({away.x, away.y, away.z}) <= 1)
        near = weightOf(own, point) / nearWeight(*around, point) * emitter.power / own.power;
    return kShareOfAll * ofAll + (1 - kShareOfAll) * near;
}

const Emitter* EmitterTable::find(world::ChunkPos tile, world::BlockIndex block, unsigned shapeFace) const {
    const auto found = byBlock_.find(blockKey(tile, block));
    if (found == byBlock_.end()) return nullptr;
    for (const std::uint32_t k : found->second) {
        const Emitter& emitter = emitters_[k];
        if (emitter.tile == tile && emitter.block == block && emitter.shapeFace == shapeFace) return &emitter;
    }
    return nullptr;
}

}  // namespace terrane::path
