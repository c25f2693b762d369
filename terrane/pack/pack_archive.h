// A pack as an archive, which servers send and clients keep, and its hash. docs/protocol.md ("Packs")
// specifies the format. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "terrane/pack/pack.h"
#include "terrane/store/bytes.h"

namespace terrane::pack {

// SHA-256 of the files' paths and contents in order. Equal packs have equal hashes, whether folder, zip file
// or archive.
using PackHash = std::array<std::byte, 32>;
PackHash hashOf(const Pack& pack);
std::string hexOf(const PackHash& hash);  // 64 digits

// The archive, compressed. The same pack gives the same bytes, with one version of zstd.
store::Bytes archiveOf(const Pack& pack);

// Takes any bytes: an error if they are no archive or the pack is beyond the bounds of pack.h.
[[nodiscard]] base::Result<Pack> packOf(store::ByteView archive, const std::string& where);

}  // namespace terrane::pack
