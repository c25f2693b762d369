// The ground that bots walk on: generated terrain without edits. Shared by all bots. One thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>

#include "apps/terrane/client_packs.h"
#include "terrane/base/result.h"
#include "terrane/gen/generator.h"
#include "terrane/net/server_message.h"
#include "terrane/net/world_proof.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

class BotLand {
  public:
    explicit BotLand(ClientPacks serverPacks) : packs(std::move(serverPacks)) {}

    ClientPacks packs;  // of the server's world

    // The answer to a server's offer, cached for the same offer. Fails if this program generates another
    // world.
    [[nodiscard]] base::Result<net::SampleDigests> prove(const net::WorldOffer& offer);
    // The height of the highest block of a column; call after prove(). Generates the chunk at the first
    // request.
    int groundHeight(std::int32_t x, std::int32_t y);
    // Call after prove().
    const world::BlockRegistry& blocks() const { return *content_.blocks; }

  private:
    using Heights = std::array<std::uint8_t, 256>;

    pack::Content content_;
    std::unique_ptr<gen::Generator> generator_;
    net::WorldOffer offer_;
    net::SampleDigests digests_{};
    std::unordered_map<world::ChunkPos, Heights, world::ChunkPosHash> heights_;
};

}  // namespace terrane::app
