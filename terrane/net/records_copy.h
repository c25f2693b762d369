// Copies what servers keep beside a world, with the numbers that players and edits have: into records that
// are empty, or hold the beginning of the same. Blocks until all is durable.
#pragma once

#include "terrane/net/server_records.h"

namespace terrane::net {

struct RecordsCopied {
    std::size_t players = 0, claims = 0;
    std::int64_t edits = 0;
};

// An error where the world's store lacks edits of the history, which only a server adds; Incompatible where
// `to` ends with another history.
[[nodiscard]] base::Result<RecordsCopied> copyRecords(ServerRecords& from, ServerRecords& to);

}  // namespace terrane::net
