// A client shows its own edits at once, and takes back what the server decides otherwise. This remembers
// which blocks are shown ahead of the server, and what the server says is there. Plain bookkeeping; the
// world's thread.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/world/block_value.h"

namespace terrane::net {

class Prediction {
  public:
    // The client applied its command `number`, which is larger than all before. `before`: the blocks that it
    // changed, with what they were.
    void predict(std::uint32_t number, std::span<const world::PlacedBlock> before);

    // The server says what blocks are. Gives those of them that no command is ahead of: they are to be shown.
    [[nodiscard]] std::vector<world::PlacedBlock> takeIn(std::span<const world::PlacedBlock> blocks);

    // The server decided on all commands up to `number`, and told what they changed. Gives the blocks that
    // these commands alone were ahead of, as the server has them.
    [[nodiscard]] std::vector<world::PlacedBlock> settle(std::uint32_t number);
    // No command will be decided any more, as the connection is gone. Gives all blocks as the server had them
    // last.
    [[nodiscard]] std::vector<world::PlacedBlock> settleAll();

    std::size_t blockCount() const { return ahead_.size(); }  // shown ahead of the server

  private:
    struct Ahead {
        world::BlockValue server;  // what the server has there
        std::uint32_t last = 0;    // the newest command that changed it
    };
    std::unordered_map<world::BlockPos, Ahead, world::BlockPosHash> ahead_;
};

}  // namespace terrane::net
