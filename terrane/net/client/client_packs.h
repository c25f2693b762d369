// The content packs of a server's world, as a client gets them: from the player's packs, else from the cache,
// else from the server. Packs are identified by their hash, not by name. Runs on the thread of the link.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrane/net/server/server_loop.h"
#include "terrane/net/wire/server_message.h"
#include "terrane/pack/content.h"
#include "terrane/pack/pack_files.h"

namespace terrane::net {

// Limit on all packs of a server together.
constexpr std::size_t kMaxServerPackBytes = std::size_t{64} << 20;

struct HeldPack {
    pack::PackHash hash{};
    pack::Pack pack;
    bool isSent = false;  // the server sent it in this run
};

struct ClientPacks {
    std::filesystem::path cache;           // folder; empty: no cache
    bool acceptsAll = false;               // the server may send every pack that its world needs
    std::vector<pack::PackHash> accepted;  // packs that the player lets the server send
    std::vector<HeldPack> packs;
    std::vector<PackOffer> missing;  // packs of the last offer that the player has to accept
};

// $XDG_CACHE_HOME/terrane/packs, else $HOME/.cache/terrane/packs; empty if neither variable is set. The
// folder may be deleted at any time.
std::filesystem::path packCacheFolder();

// Returns the numbers of the offered packs that the server has to send, for LinkEvents. Fails if the
// player did not accept one of them, or if they exceed kMaxServerPackBytes.
[[nodiscard]] base::Result<std::vector<std::uint8_t>> missingPacks(ClientPacks& packs,
                                                                   const WorldOffer& offer);
// Adds a pack from the server to `packs` and to the cache. Fails if its hash is not the offered one.
[[nodiscard]] base::Result<void> takePack(ClientPacks& packs, const PackOffer& offer,
                                          const store::Bytes& archive);
// The blocks and generators of the server's world, once no pack is missing.
[[nodiscard]] base::Result<pack::Content> contentOf(const ClientPacks& packs, const WorldOffer& offer);

// The packs that a server offers its clients. Fails if they exceed the limits of clients.
[[nodiscard]] base::Result<ServerContent> serverContent(const pack::Content& content);

// "isles 1.0 (12 KB), ores (3 KB)"
std::string textOf(std::span<const PackOffer> packs);

}  // namespace terrane::net
