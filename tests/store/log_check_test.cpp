#include "terrane/store/saves/save_check.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "tests/base/temp_folder.h"

namespace terrane::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The bytes of a big-endian word, read as a little-endian one.
constexpr std::uint32_t littleEndian(std::uint32_t word) {
    return word >> 24 | (word >> 8 & 0xff00) | (word & 0xff00) << 8 | word << 24;
}

// The header of a write-ahead log without frames, with the right checksums (SQLite's file format,
// section 4.1).
std::string logHeader(std::uint32_t pageBytes) {
    std::array<std::uint32_t, 8> words = {0x377f0682, 3007000, pageBytes, 1, 11, 12};
    std::uint32_t low = 0, high = 0;
    for (std::size_t k = 0; k < 6; k += 2) {
        low += littleEndian(words[k]) + high;
        high += littleEndian(words[k + 1]) + low;
    }
    words[6] = low;
    words[7] = high;
    std::string header;
    for (const std::uint32_t word : words)
        for (int shift = 24; shift >= 0; shift -= 8) header += static_cast<char>(word >> shift & 255);
    return header;
}

std::vector<std::string> problemsOfLog(std::uint32_t pageBytes) {
    const base::TempFolder folder;
    std::ofstream(folder / "a.sqlite-wal", std::ios::binary) << logHeader(pageBytes);
    return logProblems(folder / "a.sqlite");
}

TEST(LogCheck, PagesHaveAPowerOfTwoFrom512To65536Bytes) {
    for (const std::uint32_t bytes : {512u, 4096u, 65536u})
        EXPECT_THAT(problemsOfLog(bytes), IsEmpty()) << bytes;
    for (const std::uint32_t bytes : {0u, 1u, 256u, 513u, 768u, 65535u, 131072u, 1u << 31})
        EXPECT_THAT(problemsOfLog(bytes), ElementsAre(HasSubstr("its header is broken"))) << bytes;
}

}  // namespace
}  // namespace terrane::store
