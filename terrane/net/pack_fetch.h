// Content packs that a client lacks, asked for part by part between WorldOffer and Proof. Plain data; on the
// link's thread.
#pragma once

#include <optional>
#include <vector>

#include "terrane/net/client_message.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

struct PackFetch {
    WorldOffer offer;
    std::vector<std::uint8_t> wanted;  // numbers in offer.packs, the next one last
    Bytes archive;                     // of the next one, as far as it came
};

// The message that asks for the next part; none where all packs came.
std::optional<AskPack> nextPart(const PackFetch& fetch);

// Takes the part that was asked for: an error where it is another one, or more than the pack was said to
// have. True: the archive is complete, and the caller takes it and removes the pack from `wanted`.
[[nodiscard]] base::Result<bool> takePart(PackFetch& fetch, const PackPart& part);

}  // namespace terrane::net
