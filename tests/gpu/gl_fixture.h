// The fixture of tests that need OpenGL: a debug context without a window for each test, which fails when the
// driver reported an error, and is skipped where no context can be made.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "terrane/gpu/context.h"
#include "terrane/gpu/device_info.h"

namespace terrane::gpu {

// Ends the test program if TERRANE_EXPECT_RENDERER is set and the driver's name does not contain it, or there
// is no driver. A failure would not be enough: CTest reports a program that skips a test as skipped, whatever
// it returns.
inline void checkExpectedRenderer(const base::Result<HeadlessContext>& made) {
    const char* expected = std::getenv("TERRANE_EXPECT_RENDERER");
    if (expected == nullptr) return;
    const std::string renderer = made ? queryDevice().renderer : "none: " + made.error().message;
    if (made && renderer.find(expected) != std::string::npos) return;
    std::fprintf(stderr, "TERRANE_EXPECT_RENDERER=%s, but the driver is %s\n", expected, renderer.c_str());
    std::_Exit(1);
}

class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        base::Result<HeadlessContext> made = HeadlessContext::create({.debug = true});
        checkExpectedRenderer(made);
        if (!made) GTEST_SKIP() << "1 test skipped, no OpenGL: " << made.error().message;
        context_ = *std::move(made);
    }

    void TearDown() override {
        if (!context_.valid()) return;
        EXPECT_EQ(context_.debugErrorCount(), 0) << "the driver reported errors, see above";
    }

    HeadlessContext context_;
};

}  // namespace terrane::gpu
