// Compares an image with the one in tests/golden, or overwrites that one if TERRANE_UPDATE_GOLDEN is 1.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/golden/compare.h"

namespace terrane::golden {

struct Folders {
    std::filesystem::path golden = TERRANE_SOURCE_DIR "/tests/golden";
    std::filesystem::path failures = TERRANE_BINARY_DIR "/golden_failures";
};

inline bool wantsUpdate() {
    const char* value = std::getenv("TERRANE_UPDATE_GOLDEN");
    return value && std::string_view(value) == "1";
}

// Writes the images of a failure; returns their paths for its message.
inline std::string writeFailure(const Folders& folders, const std::string& name, const base::Image& actual,
                                const base::Image* expected) {
    std::filesystem::create_directories(folders.failures);
    const auto write = [&](const char* ending, const base::Image& image) {
        const std::filesystem::path path = folders.failures / (name + ending);
        const auto written = base::writePng(path, image);
        return "\n  " + (written ? path.string() : written.error().message);
    };
    std::string paths = write(".actual.png", actual);
    if (expected) paths += write(".difference.png", differenceImage(actual, *expected));
    return paths;
}

inline testing::AssertionResult rewriteGolden(const Folders& folders, const std::string& name,
                                              const base::Image& actual) {
    const std::filesystem::path path = folders.golden / (name + ".png");
    if (const auto written = base::writePng(path, actual); !written) {
        return testing::AssertionFailure() << written.error().message;
    }
    std::printf("golden: rewrote %s\n", path.c_str());
    return testing::AssertionSuccess();
}

inline testing::AssertionResult matchesGolden(const std::string& name, const base::Image& actual,
                                              bool update = wantsUpdate(), const Folders& folders = {}) {
    const auto failure = [&](const base::Image* expected) {
        return testing::AssertionFailure()
               << "golden " << name << writeFailure(folders, name, actual, expected) << '\n';
    };
    if (actual.rgba.empty())
        return testing::AssertionFailure() << "golden " << name << ": nothing was rendered";
    if (isFlat(actual)) return failure(nullptr) << "the image is flat: nothing was drawn";
    if (update) return rewriteGolden(folders, name, actual);
    const auto expected = base::readPng(folders.golden / (name + ".png"));
    if (!expected) {
        return failure(nullptr) << expected.error().message
                                << "\nTERRANE_UPDATE_GOLDEN=1 makes it, see README.md";
    }
    if (actual.width != expected->width || actual.height != expected->height) {
        return failure(nullptr) << "the image is " << actual.width << " × " << actual.height
                                << ", the golden is " << expected->width << " × " << expected->height;
    }
    const Difference d = difference(actual, *expected);
    if (isSame(actual, *expected)) return testing::AssertionSuccess();
    return failure(&*expected) << "differs by max " << d.max << ", mean " << d.mean << "; allowed are max "
                               << kTolerance.max << ", mean " << kTolerance.mean;
}

}  // namespace terrane::golden
