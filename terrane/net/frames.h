// Message framing in a byte stream: each message is its length as a varint, then its bytes
// (docs/protocol.md). Plain values; one thread at a time for each object.
#pragma once

#include <cstddef>
#include <optional>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace terrane::net {

void appendFrame(Bytes& stream, ByteView message);

// Splits a stream into messages as it arrives. Buffers at most one message and the bytes after it.
class FrameReader {
  public:
    // Longer messages are an error.
    explicit FrameReader(std::size_t maxMessage) : maxMessage_(maxMessage) {}

    void add(ByteView bytes);
    // The next message, valid until the next call of add(); no value while it is incomplete. The stream is
    // unusable after an error.
    [[nodiscard]] base::Result<std::optional<ByteView>> next();
    std::size_t waitingBytes() const { return bytes_.size() - begin_; }

  private:
    std::size_t maxMessage_;
    Bytes bytes_;
    std::size_t begin_ = 0;  // of the bytes not yet returned
};

}  // namespace terrane::net
