#include "terrane/net/frames.h"

#include <algorithm>

namespace terrane::net {
namespace {

// 4 digits of 7 bits: 2^28 bytes, more than any message has.
constexpr std::size_t kMaxDigits = 4;

}  // namespace

void appendFrame(Bytes& stream, ByteView message) {
    WireWriter(stream).number(message.size());
    store::append(stream, message);
}

void FrameReader::add(ByteView bytes) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
    store::append(bytes_, bytes);
}

base::Result<std::optional<ByteView>> FrameReader::next() {
    const ByteView rest = ByteView(bytes_).subspan(begin_);
    std::size_t length = 0, digits = 0;
    bool isWhole = false;
    while (digits < std::min(rest.size(), kMaxDigits) && !isWhole) {
        const auto digit = static_cast<std::size_t>(rest[digits]);
        length |= (digit & 127) << (7 * digits);
        isWhole = digit < 128;
        ++digits;
    }
    if (length > maxMessage_ || (digits == kMaxDigits && !isWhole))
        return base::fail(base::ErrorCode::Damaged, "a message of more than {} bytes", maxMessage_);
    // Only the shortest form is valid.
    if (isWhole && digits > 1 && rest[digits - 1] == std::byte{0})
        return base::fail(base::ErrorCode::Damaged, "a length that is not in its shortest form");
    if (!isWhole || rest.size() - digits < length) return std::optional<ByteView>();
    begin_ += digits + length;
    return std::optional(rest.subspan(digits, length));
}

}  // namespace terrane::net
