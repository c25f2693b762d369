// The ground that bots walk on: what the generator makes, without edits. All bots share it. One thread.
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

    // The answer to a server's offer; the same server is answered without work. An error where this program
    // makes another world.
    [[nodiscard]] base::Result<net::SampleDigests> prove(const net::WorldOffer& offer);
    // Of the highest block of a column; after prove(). Generates the chunk where it is asked for first.
    int groundHeight(std::int32_t x, std::int32_t y);
    // After prove().
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
