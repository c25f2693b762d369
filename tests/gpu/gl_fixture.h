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

// Why this is not the driver that TERRANE_EXPECT_RENDERER asks for; empty where it is.
inline std::string wrongRenderer(const std::string& expected) {
    const base::Result<HeadlessContext> made = HeadlessContext::create({});
    if (!made) return "there is no OpenGL: " + made.error().message;
    const std::string renderer = queryDevice().renderer;
    return renderer.find(expected) == std::string::npos ? "the driver is " + renderer : "";
}

// Ends a program of tests where TERRANE_EXPECT_RENDERER is set and the driver's name does not contain it. A
// failure would not do: CTest takes a program that skips a test for skipped, whatever it returns.
class ExpectedRenderer : public testing::Environment {
  public:
    void SetUp() override {
        const char* expected = std::getenv("TERRANE_EXPECT_RENDERER");
        if (expected == nullptr) return;
        const std::string reason = wrongRenderer(expected);
        if (reason.empty()) return;
        std::fprintf(stderr, "TERRANE_EXPECT_RENDERER=%s, but %s\n", expected, reason.c_str());
        std::exit(1);
    }
};

inline testing::Environment* const kExpectedRenderer =
    testing::AddGlobalTestEnvironment(new ExpectedRenderer);

class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        base::Result<HeadlessContext> made = HeadlessContext::create({.debug = true});
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
