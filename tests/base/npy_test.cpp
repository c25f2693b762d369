#include "terrane/base/npy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace terrane::base {
namespace {

using namespace std::string_literals;

struct NpyParts {
    std::string magic;
    std::size_t headerBytes = 0;
    std::string header;
    std::string data;
};

NpyParts split(const std::string& bytes) {
    NpyParts parts;
    parts.magic = bytes.substr(0, 8);
    parts.headerBytes =
        static_cast<unsigned char>(bytes.at(8)) + 256u * static_cast<unsigned char>(bytes.at(9));
    parts.header = bytes.substr(10, parts.headerBytes);
    parts.data = bytes.substr(10 + parts.headerBytes);
    return parts;
}

// The header without its padding.
std::string dictionary(const NpyParts& parts) {
    return parts.header.substr(0, parts.header.find_last_not_of(" \n") + 1);
}

TEST(Npy, MatchesTheFormatByteForByte) {
    // The output of numpy.save for numpy.array([[1, 2, 3], [4, 5, 6]], '<u2'), format version 1.0.
    const std::string dict = "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }";
    const std::string data("\1\0\2\0\3\0\4\0\5\0\6\0", 12);
    const std::string expected =
        "\x93NUMPY\x01\x00\x76\x00"s + dict + std::string(118 - dict.size() - 1, ' ') + "\n" + data;
    EXPECT_EQ(encodeNpy({"<u2", {2, 3}, data}), expected);
}

TEST(Npy, DataStartsOnA64ByteBoundaryForEveryHeaderLength) {
    std::vector<std::size_t> shape;
    for (int dimensions = 0; dimensions < 40; ++dimensions) {
        const NpyParts parts = split(encodeNpy({"|u1", shape, "x"}));
        EXPECT_EQ(parts.magic, "\x93NUMPY\x01\x00"s);
        EXPECT_EQ((10 + parts.headerBytes) % 64, 0u);
        EXPECT_EQ(parts.header.back(), '\n');
        EXPECT_EQ(parts.data, "x");
        shape.push_back(1);
    }
}

TEST(Npy, WritesShapesAsTuples) {
    EXPECT_EQ(dictionary(split(encodeNpy({"<f8", {}, std::string(8, '\0')}))),
              "{'descr': '<f8', 'fortran_order': False, 'shape': (), }");
    EXPECT_EQ(dictionary(split(encodeNpy({"<u2", {3}, std::string(6, '\0')}))),
              "{'descr': '<u2', 'fortran_order': False, 'shape': (3,), }");
    EXPECT_EQ(dictionary(split(encodeNpy({"<u2", {0, 4}, ""}))),
              "{'descr': '<u2', 'fortran_order': False, 'shape': (0, 4), }");
}

TEST(Npy, WritesRecordsWithoutQuotes) {
    const NpyParts parts = split(encodeNpy({"[('x', '|u1'), ('id', '<u2')]", {2}, "abcdef"}));
    EXPECT_EQ(dictionary(parts),
              "{'descr': [('x', '|u1'), ('id', '<u2')], 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(parts.data, "abcdef");
}

TEST(Npy, CountsLongHeadersInBothLengthBytes) {
    std::string descr = "[";
    for (int i = 0; i < 50; ++i) descr += "('field" + std::to_string(i) + "', '|u1'), ";
    descr += "]";
    const NpyParts parts = split(encodeNpy({descr, {1}, std::string(50, 'x')}));
    EXPECT_GT(parts.headerBytes, 256u);
    EXPECT_EQ(parts.header.back(), '\n');
    EXPECT_EQ(parts.data, std::string(50, 'x'));
}

// The shape of an array that is written in pieces is known at the end.
TEST(Npy, AHeaderLeavesRoomForALargerShape) {
    const std::string first = npyHeader("<u2", {SIZE_MAX});
    const std::string last = npyHeader("<u2", {7}, first.size());
    EXPECT_EQ(last.size(), first.size());
    EXPECT_EQ(dictionary(split(last)), "{'descr': '<u2', 'fortran_order': False, 'shape': (7,), }");
    EXPECT_EQ(npyHeader("<u2", {7}, 65).size(), 128u);
}

TEST(Npy, RefusesAnArrayThatIsNoneOrTooLong) {
    EXPECT_THROW((void)npyHeader("", {1}), std::invalid_argument);
    EXPECT_THROW((void)npyHeader("<u2", std::vector<std::size_t>(30'000, 1)), std::invalid_argument);
    EXPECT_THROW((void)encodeNpy({"<u2", {3}, "1234567"}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::base
