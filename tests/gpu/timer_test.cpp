#include "terrane/gpu/timer.h"

#include <type_traits>

#include "terrane/gpu/framebuffer.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<GpuTimer> && std::is_nothrow_move_assignable_v<GpuTimer>);

class TimerTest : public GlTest {};

void drawFrame(GpuTimer& timer, const Framebuffer& target) {
    timer.nextFrame();
    timer.begin("frame");
    timer.begin("clear");
    target.clearColor(0, {1, 0, 0, 1});
    timer.end();
    timer.begin("again");
    target.clearColor(0, {0, 1, 0, 1});
    timer.end();
    timer.end();
}

TEST_F(TimerTest, namesAndTimesComeSomeFramesLater) {
    const Texture2D color({256, 256}, GL_RGBA8, 1, "color");
    const base::Result<Framebuffer> target = Framebuffer::create({.colors = {color}, .depth = {}}, "target");
    ASSERT_TRUE(target) << target.error().message;
    GpuTimer timer;
    EXPECT_TRUE(timer.results().empty());
    drawFrame(timer, *target);
    EXPECT_TRUE(timer.results().empty());  // asked for, not waited for
    glFinish();                            // the test waits, the timer does not
    drawFrame(timer, *target);

    ASSERT_EQ(timer.results().size(), 3U);
    EXPECT_EQ(timer.results()[0].name, "frame");
    EXPECT_EQ(timer.results()[1].name, "clear");
    EXPECT_EQ(timer.results()[2].name, "again");
    for (const GpuTiming& timing : timer.results()) {
        EXPECT_GE(timing.milliseconds, 0.0) << timing.name;
        EXPECT_LE(timing.milliseconds, timer.results()[0].milliseconds) << timing.name;
    }
}

TEST_F(TimerTest, manyFramesWithoutWaiting) {
    const Texture2D color({64, 64}, GL_RGBA8, 1, "color");
    const base::Result<Framebuffer> target = Framebuffer::create({.colors = {color}, .depth = {}}, "target");
    ASSERT_TRUE(target) << target.error().message;
    GpuTimer timer;
    for (int frame = 0; frame < 100; ++frame) drawFrame(timer, *target);
    timer.nextFrame();  // a frame without zones leaves the results
    glFinish();
    timer.nextFrame();
    EXPECT_EQ(timer.results().size(), 3U);
    GpuTimer moved = std::move(timer);
    drawFrame(moved, *target);
    EXPECT_EQ(moved.results().size(), 3U);
}

}  // namespace
}  // namespace terrane::gpu
