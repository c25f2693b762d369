// The content packs of a server's world, as a client gets them: its own where it has the same, else from its
// cache, else from the server. The hash decides, never the name. On the thread of the link.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrane/net/server_host.h"
#include "terrane/net/server_message.h"
#include "terrane/pack/content.h"
#include "terrane/pack/pack_archive.h"

namespace terrane::app {

// The most that a client takes of a server.
constexpr std::size_t kMaxServerPackBytes = std::size_t{64} << 20;

struct HeldPack {
    pack::PackHash hash{};
    pack::Pack pack;
    bool isSent = false;  // by the server
};

struct ClientPacks {
    std::filesystem::path cache;           // folder; empty: nothing is kept
    bool acceptsAll = false;               // whether the server may send whatever its world needs
    std::vector<pack::PackHash> accepted;  // that the player lets the server send
    std::vector<HeldPack> packs;
    std::vector<net::PackOffer> missing;  // of the last offer, not accepted: the player decides
};

// $XDG_CACHE_HOME/terrane/packs, $HOME/.cache/terrane/packs where that is not set; empty where neither is. It
// may be deleted at any time.
std::filesystem::path packCacheFolder();

// For net::LinkEvents. An error where packs are missing and the player did not accept them, or where they are
// too large.
[[nodiscard]] base::Result<std::vector<std::uint8_t>> missingPacks(ClientPacks& packs,
                                                                   const net::WorldOffer& offer);
// Takes what the server sent into `packs` and the cache, where it has the hash that was offered.
[[nodiscard]] base::Result<void> takePack(ClientPacks& packs, const net::PackOffer& offer,
                                          const store::Bytes& archive);
// The blocks and generators of the server's world, once no pack is missing.
[[nodiscard]] base::Result<pack::Content> contentOf(const ClientPacks& packs, const net::WorldOffer& offer);

// What a server tells of its content. An error where it has more packs than clients take.
[[nodiscard]] base::Result<net::ServerContent> serverContent(const pack::Content& content);

// "isles 1.0 (12 KB), ores (3 KB)"
std::string describe(std::span<const net::PackOffer> packs);

}  // namespace terrane::app
