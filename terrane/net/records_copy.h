// Copies a server's records, keeping the numbers of players and edits, into records that are empty or hold
// the beginning of the same history. Blocks until all is durable.
#pragma once

#include "terrane/net/server_records.h"

namespace terrane::net {

struct RecordsCopied {
    std::size_t players = 0, claims = 0;
    std::int64_t edits = 0;
};

// Fails if the world's store lacks edits of the history, which only a server can add, and with
// ErrorCode::Incompatible if `to` has a different history.
[[nodiscard]] base::Result<RecordsCopied> copyRecords(ServerRecords& from, ServerRecords& to);

}  // namespace terrane::net
