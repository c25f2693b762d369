#include "terrane/store/log_check.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <span>

namespace terrane::store {
namespace {

// SQLite's file format, section 4: "The Write-Ahead Log".
constexpr std::size_t kLogHeaderBytes = 32, kFrameHeaderBytes = 24;
constexpr std::uint32_t kLogMagic = 0x377f0682;  // its lowest bit: words of checksums are big-endian
constexpr std::uint32_t kMinPage = 512, kMaxPage = 65536;

using LogBytes = std::span<const unsigned char>;

std::uint32_t wordAt(LogBytes bytes, std::size_t at, bool isBigEndian = true) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | bytes[at + (isBigEndian ? k : 3 - k)];
    return value;
}

struct Checksum {
    bool isBigEndian = false;
    std::uint32_t low = 0, high = 0;

    void add(LogBytes bytes) {
        for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
            low += wordAt(bytes, at, isBigEndian) + high;
            high += wordAt(bytes, at + 4, isBigEndian) + low;
        }
    }
    bool isAt(LogBytes bytes, std::size_t at) const {
        return wordAt(bytes, at) == low && wordAt(bytes, at + 4) == high;
    }
};

bool isPageSize(std::uint32_t bytes) {
    return bytes >= kMinPage && bytes <= kMaxPage && (bytes & (bytes - 1)) == 0;
}

// Frames of this log, identified by their salts: frames from before a restart of the log have others.
struct Frames {
    std::size_t whole = 0;          // intact frames from the first on
    std::size_t commitsBehind = 0;  // commits after the first broken frame
    bool isBroken = false;
};

Frames readFrames(std::istream& log, LogBytes header, Checksum sum, std::uint32_t pageBytes) {
    Frames frames;
    std::vector<unsigned char> frame(kFrameHeaderBytes + pageBytes);
    while (log.read(reinterpret_cast<char*>(frame.data()), static_cast<std::streamsize>(frame.size()))) {
        const LogBytes bytes(frame);
        const bool isOfThisLog =
            wordAt(bytes, 8) == wordAt(header, 16) && wordAt(bytes, 12) == wordAt(header, 20);
        sum.add(bytes.first(8));
        sum.add(bytes.subspan(kFrameHeaderBytes));
        frames.isBroken = frames.isBroken || !isOfThisLog || !sum.isAt(bytes, 16);
        const bool isCommit = wordAt(bytes, 4) != 0;
        if (!frames.isBroken) ++frames.whole;
        if (frames.isBroken && isOfThisLog && isCommit) ++frames.commitsBehind;
    }
    return frames;
}

}  // namespace

std::vector<std::string> logProblems(const std::filesystem::path& save) {
    std::filesystem::path path = save;
    path += "-wal";
    std::ifstream log(path, std::ios::binary);
    std::array<unsigned char, kLogHeaderBytes> header{};
    if (!log.read(reinterpret_cast<char*>(header.data()), header.size())) return {};
    const std::uint32_t magic = wordAt(header, 0), pageBytes = wordAt(header, 8);
    Checksum sum{.isBigEndian = (magic & 1) != 0};
    sum.add(LogBytes(header).first(24));
    // SQLite syncs the header before it writes the first frame: a power failure before that leaves a torn
    // header and no transactions.
    const bool isWhole = (magic & ~1u) == kLogMagic && isPageSize(pageBytes) && sum.isAt(header, 24);
    if (!isWhole) {
        return {
            fmt::format("{}: its header is broken: all that it holds is lost, unless it was never finished",
                        path.string())};
    }
    const Frames frames = readFrames(log, header, sum, pageBytes);
    if (frames.commitsBehind == 0) return {};
    // Each transaction is on disk before the next one is written; only the last one may be partial after a
    // power failure.
    const std::string lost = frames.commitsBehind == 1
                                 ? "the last transaction is lost, unless it was never finished"
                                 : fmt::format("{} transactions are lost", frames.commitsBehind);
    return {fmt::format("{}: broken behind frame {}: {}", path.string(), frames.whole, lost)};
}

}  // namespace terrane::store
