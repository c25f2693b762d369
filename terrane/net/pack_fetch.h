// Download of missing content packs, part by part, between WorldOffer and Proof. Plain data; on the link's
// thread.
#pragma once

#include <optional>
#include <vector>

#include "terrane/net/client_message.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

struct PackFetch {
    WorldOffer offer;
    std::vector<std::uint8_t> missing;  // indices into offer.packs, the next one last
    Bytes archive;                      // bytes received of the next one
};

// The request for the next part; no value once all packs are complete.
std::optional<AskPack> nextPart(const PackFetch& fetch);

// Appends the requested part. Fails for another part, or more bytes than the offer announced. Returns true
// once the archive is complete: then the caller takes it and removes the pack from `missing`.
[[nodiscard]] base::Result<bool> takePart(PackFetch& fetch, const PackPart& part);

}  // namespace terrane::net
