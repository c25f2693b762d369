#include "terrane/shared/ray_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace terrane::shared {
namespace {

using Random = std::mt19937;

float component(Random& random) {
    const float simple[] = {0, 1, -1, .5f, -.5f, 2, 3, -3};
    const unsigned kind = random() % 16;
    if (kind < 8) return simple[kind];
    return std::ldexp(static_cast<float>(random() % (1 << 20)) - 524288.f,
                      -19 - static_cast<int>(random() % 20));
}

float place(Random& random) {
    const float simple[] = {0, 1, .5f, .75f};
    const unsigned kind = random() % 8;
    return kind < 4 ? simple[kind] : std::ldexp(static_cast<float>(random() % (1 << 24)), -24);
}

Ray anyRay(Random& random) {
    const auto number = [&] { return static_cast<int>(random() % 64) - 32; };
    return makeRay({number(), number(), number(), 0}, {place(random), place(random), place(random), 0},
                   {component(random), component(random), component(random), 0}, 1e9f);
}

void stepOnce(const Ray& ray, RayPlace& at) {
    rayLeaveBox(ray, at, at.cell + 1);
}

// Boxes of 2^k cells, aligned to their size, of other sizes along each axis.
TEST(RayStepTest, LeavingABoxEndsWhereSingleStepsEnd) {
    Random random(1);
    for (int k = 0; k < 20'000; ++k) {
        const Ray ray = anyRay(random);
        RayPlace slow = rayBegin(ray), fast = slow;
        for (int box = 0; box < 8; ++box) {
            glm::ivec4 end(0);
            for (int axis = 0; axis < 3; ++axis) {
                const int bits = static_cast<int>(random() % 6);
                end[axis] = ((fast.cell[axis] >> bits) + 1) << bits;
            }
            rayLeaveBox(ray, fast, end);
            for (int n = 0; n < 200 && slow.cell.x < end.x && slow.cell.y < end.y && slow.cell.z < end.z; ++n)
                stepOnce(ray, slow);
            ASSERT_EQ(slow.cell, fast.cell) << "ray " << k << ", box " << box;
            ASSERT_EQ(floatBitsToUint(slow.t), floatBitsToUint(fast.t)) << "ray " << k << ", box " << box;
        }
    }
}

// Far from where a ray begins, where single steps would take too long: on each axis the last plane that comes
// before the one that the ray leaves by, found by halving.
TEST(RayStepTest, LongBoxesEndWhereTheirPlanesSay) {
    Random random(3);
    for (int k = 0; k < 20'000; ++k) {
        const Ray ray = anyRay(random);
        RayPlace at = rayBegin(ray);
        for (int box = 0; box < 4; ++box) {
            const RayPlace before = at;
            glm::ivec4 end(0);
            for (int axis = 0; axis < 3; ++axis) {
                const int bits = static_cast<int>(random() % 18);
                end[axis] = ((at.cell[axis] >> bits) + 1) << bits;
            }
            rayLeaveBox(ray, at, end);
            const auto planeT = [&](int axis, int cell) {
                return rayPlaneT(cell - ray.cell[axis], ray.start[axis], ray.inverse[axis]);
            };
            ASSERT_EQ(at.cell[at.axis], end[at.axis]);
            ASSERT_EQ(at.t, planeT(at.axis, end[at.axis]));
            for (int axis = 0; axis < 3; ++axis) {
                if (axis == at.axis) continue;
                int low = before.cell[axis], high = end[axis];
                while (high - low > 1) {
                    const int middle = low + (high - low) / 2;
                    const float t = planeT(axis, middle);
                    (t < at.t || (t == at.t && axis < at.axis) ? low : high) = middle;
                }
                ASSERT_EQ(at.cell[axis], low) << "ray " << k << ", box " << box << ", axis " << axis;
            }
        }
    }
}

TEST(RayStepTest, CellsFollowEachOther) {
    Random random(2);
    for (int k = 0; k < 2'000; ++k) {
        const Ray ray = anyRay(random);
        RayPlace at = rayBegin(ray);
        for (int step = 0; step < 100; ++step) {
            const RayPlace before = at;
            stepOnce(ray, at);
            const glm::ivec4 moved = at.cell - before.cell;
            ASSERT_EQ(moved.x + moved.y + moved.z, 1);
            ASSERT_EQ(moved[at.axis], 1);
            ASSERT_GE(at.t, before.t);
        }
    }
}

// A diagonal through edges and corners: x, then y, then z.
TEST(RayStepTest, EqualPlanesComeInTheOrderOfTheAxes) {
    const Ray ray = makeRay({0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1, 0}, 100);
    RayPlace at = rayBegin(ray);
    for (int corner = 1; corner <= 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            stepOnce(ray, at);
            EXPECT_EQ(at.axis, axis);
        }
        EXPECT_EQ(at.cell, glm::ivec4(corner, corner, corner, 0));
    }
}

TEST(RayStepTest, RaysThatBeginOnAFaceLeaveThroughIt) {
    const Ray up = makeRay({5, 5, 5, 0}, {.5f, .5f, 1, 0}, {.1f, .1f, 1, 0}, 100);
    const Ray down = makeRay({5, 5, 5, 0}, {.5f, .5f, 0, 0}, {.1f, .1f, -1, 0}, 100);
    for (const Ray& ray : {up, down}) {
        RayPlace at = rayBegin(ray);
        stepOnce(ray, at);
        EXPECT_EQ(at.axis, 2);
        EXPECT_EQ(at.t, 0);
        EXPECT_EQ(at.cell.z ^ ray.mirror.z, ray.mirror.z == 0 ? 6 : 4);
    }
}

TEST(RayStepTest, DirectionsAreNeverZero) {
    const Ray ray = makeRay({0, 0, 0, 0}, {.5f, .5f, .5f, 0}, {0, -0.f, 1e-30f, 0}, 100);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(ray.direction[axis], kRayMinDirection);
        EXPECT_EQ(ray.mirror[axis], 0);
        EXPECT_NEAR(ray.inverse[axis] * kRayMinDirection, 1, 1e-6);
    }
}

}  // namespace
}  // namespace terrane::shared
