#include "terrane/net/pack_fetch.h"

namespace terrane::net {

std::optional<AskPack> nextPart(const PackFetch& fetch) {
    if (fetch.missing.empty()) return std::nullopt;
    return AskPack{fetch.missing.back(), static_cast<std::uint32_t>(fetch.archive.size())};
}

base::Result<bool> takePart(PackFetch& fetch, const PackPart& part) {
    const std::optional<AskPack> asked = nextPart(fetch);
    if (!asked || part.number != asked->number || part.offset != asked->offset)
        return base::fail("the server sent a part of a pack that was not asked for");
    const std::size_t size = fetch.offer.packs[part.number].bytes;
    if (part.data.empty() || fetch.archive.size() + part.data.size() > size)
        return base::fail("the server sent a different pack than it offered");
    store::append(fetch.archive, part.data);
    return fetch.archive.size() == size;
}

}  // namespace terrane::net
