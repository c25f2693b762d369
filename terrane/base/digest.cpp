#include "terrane/base/digest.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

#include "terrane/base/result.h"

namespace terrane::base {

Digest::Digest() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
}

void Digest::update(std::span<const std::byte> bytes) {
    require(state_ != nullptr, "Digest::update: the digest was moved from");
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

void Digest::update(std::string_view text) {
    update(std::as_bytes(std::span(text)));
}

std::string Digest::hex() const {
    require(state_ != nullptr, "Digest::hex: the digest was moved from");
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

void Digest::FreeState::operator()(XXH3_state_s* state) const {
    XXH3_freeState(state);
}

std::uint64_t hash64(std::string_view text) {
    return XXH64(text.data(), text.size(), 0);
}

}  // namespace terrane::base
