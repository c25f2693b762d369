#include "terrane/gen/generators/trees/canvas.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace terrane::gen::trees {
namespace {

constexpr int kSide = 2 * kMaxShapeReach + 1, kLayers = kMaxShapeZ - kMinShapeZ + 1;

}  // namespace

Canvas::Canvas() : cells_(std::size_t{kSide} * kSide * kLayers) {}

std::size_t Canvas::index(int x, int y, int z) {
    return static_cast<std::size_t>(((z - kMinShapeZ) * kSide + y + kMaxShapeReach) * kSide + x +
                                    kMaxShapeReach);
}

bool Canvas::isInside(int x, int y, int z) const {
    return std::max(std::abs(x), std::abs(y)) <= kMaxShapeReach && z >= kMinShapeZ && z <= kMaxShapeZ;
}

Canvas::Paint Canvas::paint(std::string_view block, int rank) {
    const ShapeBlock entry = {std::string(block), rank};
    const auto known = std::find(blocks_.begin(), blocks_.end(), entry);
    const auto number = static_cast<Paint>(known - blocks_.begin() + 1);
    if (known == blocks_.end()) blocks_.push_back(entry);
    return number;
}

Canvas::Paint Canvas::at(int x, int y, int z) const {
    return isInside(x, y, z) ? cells_[index(x, y, z)] : Paint{0};
}

void Canvas::set(int x, int y, int z, Paint paint) {
    if (!isInside(x, y, z)) return;
    Paint& cell = cells_[index(x, y, z)];
    if (!isWood(cell) || isWood(paint)) cell = paint;
}

void Canvas::ball(Point middle, float radius, Paint paint) {
    if (radius < 0.75f) return set(roundToInt(middle.x), roundToInt(middle.y), roundToInt(middle.z), paint);
    const int reach = static_cast<int>(radius + 1.0f);
    const int mx = roundToInt(middle.x), my = roundToInt(middle.y), mz = roundToInt(middle.z);
    for (int z = mz - reach; z <= mz + reach; ++z) {
        for (int y = my - reach; y <= my + reach; ++y) {
            for (int x = mx - reach; x <= mx + reach; ++x) {
                const Point at = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
                if (lengthSquared(at - middle) <= radius * radius) set(x, y, z, paint);
            }
        }
    }
}

void Canvas::limb(Point from, Point to, float fromRadius, float toRadius, Paint paint) {
    const int steps = 1 + static_cast<int>(lengthOf(to - from) * 2.0f);
    for (int k = 0; k <= steps; ++k) {
        const float t = shared::detDivide(static_cast<float>(k), static_cast<float>(steps));
        ball(from + (to - from) * t, fromRadius + (toRadius - fromRadius) * t, paint);
    }
}

void Canvas::clump(Point middle, Point radii, float edge, Paint paint, Random& random) {
    const Point inverse = {shared::detReciprocal(radii.x), shared::detReciprocal(radii.y),
                           shared::detReciprocal(radii.z)};
    const int reach = static_cast<int>(std::max(radii.x, std::max(radii.y, radii.z)) + 1.0f);
    const int mx = roundToInt(middle.x), my = roundToInt(middle.y), mz = roundToInt(middle.z);
    for (int z = mz - reach; z <= mz + reach; ++z) {
        for (int y = my - reach; y <= my + reach; ++y) {
            for (int x = mx - reach; x <= mx + reach; ++x) {
                const Point d =
                    Point{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} - middle;
                const float far = lengthSquared({d.x * inverse.x, d.y * inverse.y, d.z * inverse.z});
                if (far > 1.0f) continue;
                const float chance = far < 0.4f ? 1.0f : 1.0f - (1.0f - edge) * (far - 0.4f) * (1.0f / 0.6f);
                if (random.unit() < chance) set(x, y, z, paint);
            }
        }
    }
}

void Canvas::removeDisconnected() {
    std::vector<bool> isKept(cells_.size());
    std::vector<std::array<int, 3>> open;
    const auto keep = [&](int x, int y, int z) {
        if (at(x, y, z) == 0 || isKept[index(x, y, z)]) return;
        isKept[index(x, y, z)] = true;
        open.push_back({x, y, z});
    };
    keep(0, 0, 0);
    while (!open.empty()) {
        const auto [x, y, z] = open.back();
        open.pop_back();
        for (int n = 0; n < 27; ++n) {
            const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 - 1;
            const bool isFace = std::abs(dx) + std::abs(dy) + std::abs(dz) == 1;
            const bool isLimb = isWood(at(x, y, z)) && isWood(at(x + dx, y + dy, z + dz));
            if (isFace || isLimb) keep(x + dx, y + dy, z + dz);
        }
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        if (!isKept[k]) cells_[k] = 0;
    }
}

VoxelShape Canvas::shape(std::string name) const {
    VoxelShape result = {std::move(name), blocks_, {}};
    for (int z = kMinShapeZ; z <= kMaxShapeZ; ++z) {
        for (int y = -kMaxShapeReach; y <= kMaxShapeReach; ++y) {
            for (int x = -kMaxShapeReach; x <= kMaxShapeReach; ++x) {
                const Paint paint = cells_[index(x, y, z)];
                if (paint == 0) continue;
                result.voxels.push_back({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
                                         static_cast<std::int8_t>(z), static_cast<std::uint8_t>(paint - 1)});
            }
        }
    }
    return result;
}

}  // namespace terrane::gen::trees
