#include "terrane/io/world_options.h"

#include <algorithm>
#include <charconv>
#include <thread>

#include "terrane/base/digest.h"

namespace terrane::io {
namespace {

bool isWholeNumber(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

unsigned threadCount(const WorldOptions& options) {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

base::Result<WrittenSeed> seedFrom(std::string_view text) {
    std::uint64_t seed = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, seed);
    if (error == std::errc() && next == end) return WrittenSeed{seed, ""};
    if (text.empty() || isWholeNumber(text))
        return base::fail(base::ErrorCode::BadInput,
                          "expected a whole number from 0 to {}, or another text, got \"{}\"", UINT64_MAX,
                          text);
    return WrittenSeed{base::hash64(text), std::string(text)};
}

}  // namespace terrane::io
