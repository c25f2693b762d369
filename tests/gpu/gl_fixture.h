// The fixture of tests that need OpenGL. All tests of a process share one debug context without a window:
// creating it takes longer than most tests. A test fails when the driver reported an error, and is skipped
// where no context can be made.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "terrane/gpu/context.h"
#include "terrane/gpu/program.h"

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

// Created by the first test; never destroyed, since drivers may be gone when static objects are.
inline base::Result<HeadlessContext>& sharedContext() {
    static auto* context = [] {
        auto made = HeadlessContext::create({.debug = true});
        checkExpectedRenderer(made);
        return new base::Result<HeadlessContext>(std::move(made));
    }();
    return *context;
}

class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        base::Result<HeadlessContext>& shared = sharedContext();
        if (!shared) GTEST_SKIP() << "1 test skipped, no OpenGL: " << shared.error().message;
        context().makeCurrent();
    }

    void TearDown() override {
        if (!hasContext()) return;
        EXPECT_EQ(context().debugErrorCount(), 0) << "the driver reported errors, see above";
        context().debugLog()->clear();
        Program::useNone();  // or the next test's state is checked against this test's program
    }

    static bool hasContext() { return sharedContext().has_value(); }
    static HeadlessContext& context() { return *sharedContext(); }
};

}  // namespace terrane::gpu
