#include "terrane/formats/gray_png.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "terrane/base/image.h"

namespace terrane::formats {
namespace {

TEST(GrayPng, IsReadByAnotherReader) {
    GrayImage gray{3, 2, 8, {0, 1, 255, 7, 200, 6}};
    const auto image = base::decodePng(encodeGrayPng(gray), "gray");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 3);
    for (std::size_t k = 0; k < gray.values.size(); ++k) EXPECT_EQ(image->rgba[4 * k], gray.values[k]);
    gray.bits = 16;
    gray.values = {0, 257, 65535, 513, 40000, 25700};
    const auto deep = base::decodePng(encodeGrayPng(gray), "gray");
    ASSERT_TRUE(deep) << deep.error().message;
    // Read as linear light by this reader: black and white stay.
    EXPECT_EQ(deep->rgba[0], 0);
    EXPECT_EQ(deep->rgba[8], 255);
}

TEST(GrayPng, RefusesAnImageThatIsNone) {
    EXPECT_THROW((void)encodeGrayPng({1, 1, 4, {0}}), std::invalid_argument);
    EXPECT_THROW((void)encodeGrayPng({0, 1, 8, {}}), std::invalid_argument);
    EXPECT_THROW((void)encodeGrayPng({2, 1, 8, {0}}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::formats
