#include "terrane/game/figure_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "terrane/shared/figure.h"
#include "terrane/world/character.h"

namespace terrane::game {
namespace {

using world::Figure;
using world::Pose;

constexpr double kFigureFrame = 1.0 / 60;

FigureMotion::Time timeAt(double seconds) {
    return FigureMotion::Time{} +
           std::chrono::duration_cast<FigureMotion::Time::duration>(std::chrono::duration<double>(seconds));
}

double blocksBetween(const Figure& a, const Figure& b) {
    return glm::distance(a.eyes, b.eyes);
}

double turnBetween(float a, float b) {
    return std::abs(std::remainder(double{b} - double{a}, 360.0));
}

struct Told {
    double seconds;
    Pose pose;
};

// All frames until `end`, with poses at their arrival.
std::vector<Figure> framesOf(FigureMotion& motion, const std::vector<Told>& poses, double end) {
    std::vector<Figure> frames;
    std::size_t next = 0;
    for (double now = 0; now < end; now += kFigureFrame) {
        for (; next < poses.size() && poses[next].seconds <= now; ++next)
            motion.addPose(poses[next].pose, timeAt(poses[next].seconds));
        frames.push_back(motion.at(timeAt(now)));
    }
    return frames;
}

// A player who walks along +x; poses are sent evenly and arrive up to `jitter` seconds late.
std::vector<Told> walkAlongX(double interval, double jitter, double speed, double seconds) {
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> late(0, jitter);
    std::vector<Told> poses;
    for (double sent = interval; sent < seconds; sent += interval)
        poses.push_back({sent + late(random), {{speed * sent, 0, 80}, 0, 0}});
    return poses;
}

TEST(FigureMotion, IsWhereItBegan) {
    FigureMotion motion({{3, 4, 5}, 30, -10}, timeAt(0), 7);
    const Figure figure = motion.at(timeAt(0.5));
    EXPECT_EQ(figure.eyes, glm::dvec3(3, 4, 5));
    EXPECT_EQ(figure.yaw, 30);
    EXPECT_EQ(figure.pitch, -10);
    EXPECT_EQ(figure.bodyYaw, 30);
    EXPECT_EQ(figure.look, 7u);
    EXPECT_EQ(figure.strideSize, 0);
    EXPECT_EQ(figure.swing, 0);
}

// From near and far, with late poses.
TEST(FigureMotion, WalksWithoutJumps) {
    constexpr double kSpeed = world::kWalkSpeed;
    for (const double interval : {0.1, 0.2, 0.5, 1.0}) {
        for (const double jitter : {0.0, 0.2 * interval, 0.5 * interval}) {
            FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
            const auto frames = framesOf(motion, walkAlongX(interval, jitter, kSpeed, 12), 12);
            double fastest = 0;
            for (std::size_t k = 1; k < frames.size(); ++k) {
                EXPECT_GE(frames[k].eyes.x, frames[k - 1].eyes.x) << "goes back";
                fastest = std::max(fastest, blocksBetween(frames[k - 1], frames[k]) / kFigureFrame);
            }
            // The figure makes up for a late pose within the next interval.
            EXPECT_LE(fastest, kSpeed * (1.05 + 1.5 * jitter / interval)) << interval << ' ' << jitter;
            // 1.2 intervals behind, and as much as the last pose was late.
            EXPECT_NEAR(frames.back().eyes.x, kSpeed * (12 - 1.2 * interval),
                        kSpeed * (0.5 * interval + 2 * jitter + kFigureFrame));
        }
    }
}

TEST(FigureMotion, GoesEvenlyWherePosesComeEvenly) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    const auto frames = framesOf(motion, walkAlongX(0.25, 0, world::kWalkSpeed, 6), 6);
    for (std::size_t k = 180; k + 1 < frames.size(); ++k)
        EXPECT_NEAR(blocksBetween(frames[k], frames[k + 1]) / kFigureFrame, world::kWalkSpeed, 0.05) << k;
}

TEST(FigureMotion, StopsAtTheLastPose) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    const auto frames = framesOf(motion, walkAlongX(0.1, 0.03, world::kWalkSpeed, 3), 5);
    const double last = walkAlongX(0.1, 0, world::kWalkSpeed, 3).back().pose.position.x;
    EXPECT_NEAR(frames.back().eyes.x, last, 1e-9);
    EXPECT_NEAR(double{frames.back().strideSize}, 0, 1e-3);
    EXPECT_EQ(frames.back().stride, frames[frames.size() - 30].stride) << "stands on both feet";
    EXPECT_GT(frames[120].strideSize, 0.6f) << "walked before";
}

// The first pose after a long time tells nothing about the interval.
TEST(FigureMotion, StartsAtOnceAfterStanding) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    framesOf(motion, walkAlongX(0.1, 0, world::kWalkSpeed, 3), 30);
    const double from = motion.at(timeAt(30)).eyes.x;
    motion.addPose({{from + 0.45, 0, 80}, 0, 0}, timeAt(30));
    EXPECT_NEAR(motion.at(timeAt(30.15)).eyes.x, from + 0.45, 0.01);
}

TEST(FigureMotion, JumpsWhereTheStepIsLong) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    motion.addPose({{0, 31, 80}, 0, 0}, timeAt(1));
    EXPECT_NEAR(motion.at(timeAt(1.01)).eyes.y, 0, 5) << "on its way";
    motion.addPose({{500, 0, 90}, 100, 5}, timeAt(3));
    const Figure there = motion.at(timeAt(3.001));
    EXPECT_EQ(there.eyes, glm::dvec3(500, 0, 90));
    EXPECT_EQ(there.yaw, 100);
    EXPECT_NEAR(double{there.bodyYaw}, 100, 1e-3);
    EXPECT_LT(there.strideSize, 0.1f) << "no step was made";
}

TEST(FigureMotion, TurnsTheShortWay) {
    FigureMotion motion({{0, 0, 80}, 170, 0}, timeAt(0), 0);
    motion.addPose({{0, 0, 80}, -170, 0}, timeAt(0.1));
    float before = motion.at(timeAt(0.1)).yaw;
    double turned = 0;
    for (double now = 0.1; now < 0.5; now += kFigureFrame) {
        const float yaw = motion.at(timeAt(now)).yaw;
        turned += turnBetween(before, yaw);
        EXPECT_LE(turnBetween(yaw, 180), 10.01) << "never the long way";
        before = yaw;
    }
    EXPECT_NEAR(turned, 20, 0.1);
    EXPECT_NEAR(turnBetween(before, -170), 0, 0.01);
}

TEST(FigureMotion, TheBodyFollowsTheHead) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    std::vector<Told> poses;
    for (int k = 1; k <= 60; ++k) poses.push_back({0.1 * k, {{0, 0, 80}, 12.0f * static_cast<float>(k), 0}});
    for (const Figure& figure : framesOf(motion, poses, 7))
        EXPECT_LE(turnBetween(figure.bodyYaw, figure.yaw), double{FigureMotion::kMaxBodyLag} + 0.01);
    EXPECT_NEAR(turnBetween(motion.at(timeAt(7.1)).bodyYaw, 0), 50, 0.1) << "720° is 0, and the lag stays";
}

// Between two frames in which it walks at an even pace.
double strideOf(float yaw) {
    FigureMotion motion({{0, 0, 80}, yaw, 0}, timeAt(0), 0);
    auto poses = walkAlongX(0.1, 0, world::kWalkSpeed, 4);
    for (Told& told : poses) told.pose.yaw = yaw;
    const auto frames = framesOf(motion, poses, 4);
    return std::remainder(double{frames[200].stride} - double{frames[199].stride}, 2 * std::numbers::pi);
}

TEST(FigureMotion, LegsGoTheWayOfTheBody) {
    EXPECT_GT(strideOf(0), 0.1);
    EXPECT_GT(strideOf(60), 0.1) << "aside";
    EXPECT_LT(strideOf(180), -0.1) << "backward";
}

// While the body passes over a foot, half of the time, the foot turns from one end of its swing to the other.
TEST(FigureMotion, FeetDoNotSlide) {
    for (const double speed : {1.0, 2.5, world::kWalkSpeed, world::kRunSpeed}) {
        FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
        const auto frames = framesOf(motion, walkAlongX(0.1, 0, speed, 8), 8);
        double phase = 0;
        for (std::size_t k = 240; k < 420; ++k)
            phase +=
                std::remainder(double{frames[k + 1].stride} - double{frames[k].stride}, 2 * std::numbers::pi);
        const double blocksAStep = speed * 180 * kFigureFrame / (phase / std::numbers::pi);
        const double swing = double{shared::kFigureMostSwing} * double{frames[400].strideSize};
        EXPECT_NEAR(blocksAStep, 2 * double{shared::kFigureLeg} * std::sin(swing), 0.02) << speed;
    }
}

TEST(FigureMotion, StepsGrowWithTheSpeedUntilOneFlies) {
    const auto sizeAt = [](double speed) {
        FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
        return framesOf(motion, walkAlongX(0.1, 0, speed, 4), 4).back().strideSize;
    };
    EXPECT_GT(sizeAt(world::kWalkSpeed), sizeAt(1) + 0.2f);
    EXPECT_NEAR(double{sizeAt(world::kRunSpeed)}, 1, 0.02);
    EXPECT_NEAR(double{sizeAt(60)}, 0, 0.02);
}

TEST(FigureMotion, TheArmSwingsOnce) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    EXPECT_EQ(motion.at(timeAt(0.9)).swing, 0);
    motion.swing(timeAt(1));
    float before = 0;
    for (double now = 1.01; now < 1.29; now += kFigureFrame) {
        const float swing = motion.at(timeAt(now)).swing;
        EXPECT_GT(swing, before);
        before = swing;
    }
    EXPECT_GT(before, 0.8f);
    EXPECT_EQ(motion.at(timeAt(1.31)).swing, 0);
}

// Two poses that a slow network delivers at once, and a frame of no length.
TEST(FigureMotion, NothingIsDividedByZero) {
    FigureMotion motion({{0, 0, 80}, 0, 0}, timeAt(0), 0);
    motion.addPose({{1, 0, 80}, 0, 0}, timeAt(1));
    motion.addPose({{2, 0, 80}, 0, 0}, timeAt(1));
    for (const double now : {1.0, 1.0, 1.01, 3.0}) {
        const Figure figure = motion.at(timeAt(now));
        for (const double value : {figure.eyes.x, double{figure.stride}, double{figure.strideSize},
                                   double{figure.bodyYaw}, double{figure.yaw}})
            EXPECT_TRUE(std::isfinite(value));
    }
}

}  // namespace
}  // namespace terrane::game
