// Messages in a stream of bytes: each is a number, how many bytes it has, then the bytes (docs/protocol.md).
// Plain values; one thread at a time for each object.
#pragma once

#include <cstddef>
#include <optional>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace terrane::net {

void appendFrame(Bytes& stream, ByteView message);

// Takes a stream apart as it comes. It keeps at most one message, and what came after it.
class FrameReader {
  public:
    // Messages of more bytes are an error.
    explicit FrameReader(std::size_t maxMessage) : maxMessage_(maxMessage) {}

    void add(ByteView bytes);
    // The next message, which holds until the next call of add(); nothing where it is not whole yet. After an
    // error the stream is of no use.
    [[nodiscard]] base::Result<std::optional<ByteView>> next();
    std::size_t waitingBytes() const { return bytes_.size() - begin_; }

  private:
    std::size_t maxMessage_;
    Bytes bytes_;
    std::size_t begin_ = 0;  // of what is not taken
};

}  // namespace terrane::net
