// zstd with a context for each thread, made once: a context takes longer to make than a chunk to compress.
// Any thread may call.
#pragma once

#include "terrane/base/result.h"
#include "terrane/store/bytes.h"

namespace terrane::store {

// Appends one zstd frame to `out`. The same bytes give the same frame (with one version of zstd).
void appendCompressed(Bytes& out, ByteView bytes);

// Fills `target` from one frame, which must hold exactly that many bytes.
[[nodiscard]] base::Result<void> decompress(ByteView frame, std::span<std::byte> target);

}  // namespace terrane::store
