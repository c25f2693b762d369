// The fixture of tests that need OpenGL: a debug context without a window for each test, which fails when the
// driver reported an error, and is skipped where no context can be made.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "terrane/gpu/context.h"

namespace terrane::gpu {

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
