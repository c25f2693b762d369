#include "terrane/path/emitters.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

namespace terrane::path {
namespace {

glm::dvec3 middleOf(const Emitter& emitter) {
    return emitter.corner + 0.5 * glm::dvec3(emitter.alongU + emitter.alongV);
}

glm::ivec3 keyOf(const glm::dvec3& point, int bits) {
    return glm::ivec3(glm::floor(point)) >> bits;
}
glm::dvec3 middleOf(glm::ivec3 key, int bits) {
    return glm::dvec3(key * (1 << bits) + (1 << (bits - 1)));
}
float halfSquared(int bits) {
    return static_cast<float>(1 << 2 * (bits - 1));
}

// Power of a face for light at a point: none if it shows its back.
float powerAt(const Emitter& emitter, const glm::dvec3& point) {
    const bool isFront = glm::dot(glm::dvec3(emitter.normal), point - emitter.corner) > 0;
    return isFront || emitter.isTwoSided ? emitter.power : 0;
}
float powerAt(std::span<const Emitter> group, const glm::dvec3& point) {
    float sum = 0;
    for (const Emitter& emitter : group) sum += powerAt(emitter, point);
    return sum;
}

bool comesBefore(glm::ivec3 a, glm::ivec3 b) {
    if (a.z != b.z) return a.z < b.z;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

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

float EmitterTable::Span::weight(const glm::dvec3& point) const {
    const glm::dvec3 away = middle - point;
    return power / std::max(static_cast<float>(glm::dot(away, away)), least2);
}

glm::ivec3 EmitterTable::cellKeyOf(const glm::dvec3& point) {
    return keyOf(point, kCellBits);
}

EmitterTable::EmitterTable(std::vector<Emitter> emitters) : emitters_(std::move(emitters)) {
    std::stable_sort(emitters_.begin(), emitters_.end(), [](const Emitter& a, const Emitter& b) {
        const glm::ivec3 cellA = cellKeyOf(middleOf(a)), cellB = cellKeyOf(middleOf(b));
        if (cellA != cellB) return comesBefore(cellA, cellB);
        return comesBefore(keyOf(middleOf(a), kGroupBits), keyOf(middleOf(b), kGroupBits));
    });
    double sum = 0;
    glm::ivec3 group(0);
    for (std::uint32_t k = 0; k < emitters_.size(); ++k) {
        const Emitter& emitter = emitters_[k];
        sum += double{emitter.power};
        cumulative_.push_back(sum);
        byBlock_[blockKey(emitter.tile, emitter.block)].push_back(k);
        const glm::ivec3 key = cellKeyOf(middleOf(emitter)), own = keyOf(middleOf(emitter), kGroupBits);
        const auto [at, isNew] = byPlace_.try_emplace(key, static_cast<std::uint32_t>(cells_.size()));
        if (isNew) {
            cells_.push_back({});
            cells_.back().groups = {.first = static_cast<std::uint32_t>(groups_.size()),
                                    .middle = middleOf(key, kCellBits),
                                    .least2 = halfSquared(kCellBits)};
        }
        Cell& cell = cells_[at->second];
        cell.groups.power += emitter.power;
        if (isNew || own != group) {
            groups_.push_back(
                {.first = k, .middle = middleOf(own, kGroupBits), .least2 = halfSquared(kGroupBits)});
            ++cell.groups.count;
            group = own;
        }
        ++groups_.back().count;
        groups_.back().power += emitter.power;
        groupOf_.push_back(static_cast<std::uint32_t>(groups_.size() - 1));
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
    const auto found = byPlace_.find(cellKeyOf(point));
    return found != byPlace_.end() ? &cells_[found->second] : nullptr;
}

float EmitterTable::nearWeight(const Cell& around, const glm::dvec3& point) const {
    float sum = 0;
    for (int k = 0; k < around.nearCount; ++k)
        sum += cells_[around.near[static_cast<std::size_t>(k)]].groups.weight(point);
    return sum;
}

float EmitterTable::groupWeight(const Span& groups, const glm::dvec3& point) const {
    float sum = 0;
    for (std::uint32_t k = 0; k < groups.count; ++k) sum += groups_[groups.first + k].weight(point);
    return sum;
}

// Any face, by power.
const Emitter* EmitterTable::pick(float random) const {
    const double at = double{random} * cumulative_.back();
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at) - cumulative_.begin();
    return &emitters_[std::min(static_cast<std::size_t>(found), emitters_.size() - 1)];
}

std::optional<EmitterTable::Choice> EmitterTable::choose(const glm::dvec3& point, Random& random) const {
    if (isEmpty()) return std::nullopt;
    const Cell* around = cellAt(point);
    if (around == nullptr && random.next() >= kChanceFar) return std::nullopt;
    const Emitter* chosen = nullptr;
    if (around == nullptr || random.next() < kShareOfAll) {
        chosen = pick(random.next());
    } else {
        float left = random.next() * nearWeight(*around, point);
        int k = 0;
        for (; k < around->nearCount - 1; ++k) {
            left -= cells_[around->near[static_cast<std::size_t>(k)]].groups.weight(point);
            if (left < 0) break;
        }
        const Span& groups = cells_[around->near[static_cast<std::size_t>(k)]].groups;
        left = random.next() * groupWeight(groups, point);
        std::uint32_t n = 0;
        for (; n < groups.count - 1; ++n) {
            left -= groups_[groups.first + n].weight(point);
            if (left < 0) break;
        }
        const Span& group = groups_[groups.first + n];
        const std::span<const Emitter> faces(&emitters_[group.first], group.count);
        left = random.next() * powerAt(faces, point);
        for (const Emitter& face : faces) {
            const float power = powerAt(face, point);
            if (power > 0) chosen = &face;
            left -= power;
            if (chosen != nullptr && left < 0) break;
        }
        if (chosen == nullptr) return std::nullopt;
    }
    return Choice{chosen, chanceOf(*chosen, point)};
}

float EmitterTable::chanceOf(const Emitter& emitter, const glm::dvec3& point) const {
    const float ofAll = static_cast<float>(double{emitter.power} / cumulative_.back());
    const Cell* around = cellAt(point);
    if (around == nullptr) return kChanceFar * ofAll;
    const glm::ivec3 key = cellKeyOf(middleOf(emitter)), away = glm::abs(key - cellKeyOf(point));
    float near = 0;
    if (std::max({away.x, away.y, away.z}) <= 1) {
        const Span& groups = cells_[byPlace_.at(key)].groups;
        const Span& group = groups_[groupOf_[static_cast<std::size_t>(&emitter - emitters_.data())]];
        const float power = powerAt(emitter, point);
        if (power > 0)
            near = groups.weight(point) / nearWeight(*around, point) * group.weight(point) /
                   groupWeight(groups, point) * power /
                   powerAt(std::span(&emitters_[group.first], group.count), point);
    }
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
