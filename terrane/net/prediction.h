// Client-side prediction: remembers which blocks show an own edit that the server has not decided yet, and
// the server's value of them. Plain bookkeeping; the world's thread.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/world/block_value.h"

namespace terrane::net {

class Prediction {
  public:
    // The client applied command `number`, larger than all before. `before`: the changed blocks with their
    // previous values.
    void predict(std::uint32_t number, std::span<const world::PlacedBlock> before);

    // Takes block values from the server. Returns the blocks without a pending command: they are to be shown.
    [[nodiscard]] std::vector<world::PlacedBlock> takeIn(std::span<const world::PlacedBlock> blocks);

    // The server decided on all commands up to `number` and sent their changes. Returns the blocks without
    // further pending commands, with the server's values.
    [[nodiscard]] std::vector<world::PlacedBlock> settle(std::uint32_t number);
    // The connection was lost: no pending command will be decided. Returns all pending blocks with the
    // server's last values.
    [[nodiscard]] std::vector<world::PlacedBlock> settleAll();

    std::size_t blockCount() const { return ahead_.size(); }  // with pending commands

  private:
    struct Ahead {
        world::BlockValue server;  // the server's value
        std::uint32_t last = 0;    // newest command that changed the block
    };
    std::unordered_map<world::BlockPos, Ahead, world::BlockPosHash> ahead_;
};

}  // namespace terrane::net
