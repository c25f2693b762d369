#include "apps/terrane/seed_text.h"

#include <charconv>

#include "terrane/base/digest.h"

namespace terrane::app {
namespace {

bool isWholeNumber(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

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

}  // namespace terrane::app
