// zstd with one context per thread: creating a context takes longer than compressing a chunk. Any thread may
// call.
#pragma once

#include "terrane/base/result.h"
#include "terrane/store/bytes.h"

namespace terrane::store {

// Appends one zstd frame to `out`. Deterministic for one version of zstd.
void appendCompressed(Bytes& out, ByteView bytes);

// Decompresses one frame, which must fill `target` exactly.
[[nodiscard]] base::Result<void> decompress(ByteView frame, std::span<std::byte> target);

}  // namespace terrane::store
