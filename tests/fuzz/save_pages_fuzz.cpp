// libFuzzer: a save with changed bytes in the file, its log and a journal. The input is a list of changes to
// smallSave(). On demand checksums of the log are corrected, so that SQLite accepts its contents.
#include <algorithm>
#include <cstring>

#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/fuzz_saves.h"

namespace {

using namespace terrane;
using fuzz::FuzzInput;

constexpr std::size_t kPage = 512, kLogHeader = 32, kFrameHeader = 24;
constexpr std::size_t kMostGrowth = 4096;  // bytes past the end

std::uint32_t wordAt(const std::string& bytes, std::size_t at, bool isBigEndian) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k)
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + (isBigEndian ? k : 3 - k)]);
    return value;
}

void putWord(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(value >> (24 - 8 * k));
}

// SQLite's file format, section 4.2.
struct LogSum {
    bool isBigEndian = false;
    std::uint32_t low = 0, high = 0;

    void add(const std::string& bytes, std::size_t begin, std::size_t count) {
        for (std::size_t at = begin; at + 8 <= begin + count; at += 8) {
            low += wordAt(bytes, at, isBigEndian) + high;
            high += wordAt(bytes, at + 4, isBigEndian) + low;
        }
    }
    void put(std::string& bytes, std::size_t at) const {
        putWord(bytes, at, low);
        putWord(bytes, at + 4, high);
    }
};

void repairLog(std::string& log) {
    if (log.size() < kLogHeader) return;
    LogSum sum{.isBigEndian = (log[3] & 1) != 0};
    sum.add(log, 0, 24);
    sum.put(log, 24);
    for (std::size_t at = kLogHeader; at + kFrameHeader + kPage <= log.size(); at += kFrameHeader + kPage) {
        std::copy_n(log.begin() + 16, 8, log.begin() + static_cast<std::ptrdiff_t>(at) + 8);  // the salts
        sum.add(log, at, 8);
        sum.add(log, at + kFrameHeader, kPage);
        sum.put(log, at + 16);
    }
}

void write(std::string& bytes, std::size_t at, std::span<const std::uint8_t> patch) {
    if (at > bytes.size() + kMostGrowth) return;
    bytes.resize(std::max(bytes.size(), at + patch.size()), '\0');
    std::memcpy(bytes.data() + at, patch.data(), patch.size());
}

void change(std::string& bytes, FuzzInput& input) {
    switch (input.byte() % 6) {
        case 0:  // anywhere
            return write(bytes, input.number(2), input.bytes(1 + input.byte() % 32));
        case 1: {  // at the head of a page of the file
            const std::size_t page = input.byte() % 32;
            return write(bytes, page * kPage + input.byte() % 48, input.bytes(1 + input.byte() % 4));
        }
        case 2:  // the head of the file or of the log
            return write(bytes, input.byte() % 100, input.bytes(1 + input.byte() % 4));
        case 3:
            return bytes.resize(std::min<std::size_t>(input.number(2), bytes.size()));
        case 4: {  // a page over another
            const std::size_t from = input.byte() % 32 * kPage, to = input.byte() % 32 * kPage;
            const std::string page = from < bytes.size() ? bytes.substr(from, kPage) : "";
            return write(bytes, to, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
        }
        default:
            if (const std::size_t at = input.number(2); at < bytes.size())
                bytes[at] = static_cast<char>(bytes[at] ^ 1 << input.byte() % 8);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzInput input(data, size);
    const std::uint8_t flags = input.byte();
    fuzz::SaveBytes save = flags & 4 ? fuzz::tallSave() : fuzz::smallSave();
    if (flags & 1) save.log.clear();
    std::string journal;
    while (!input.isEmpty()) {
        const std::uint8_t what = input.byte();
        if (what < 128) {
            change(save.file, input);
        } else if (what < 224) {
            change(save.log, input);
        } else {
            journal += input.text();
        }
    }
    if (flags & 2) repairLog(save.log);
    fuzz::writeSave(save);
    if (!journal.empty()) fuzz::writeWhole(fuzz::savePath().string() + "-journal", journal);
    fuzz::useSave();
    return 0;
}
