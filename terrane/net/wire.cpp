#include "terrane/net/wire.h"

#include "terrane/net/plain_text.h"

namespace terrane::net {

void WireWriter::number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) fixed(static_cast<std::uint8_t>(value | 0x80));
    fixed(static_cast<std::uint8_t>(value));
}

void WireWriter::bytes(ByteView value) {
    number(value.size());
    store::append(bytes_, value);
}

std::uint64_t WireReader::varint() {
    std::uint64_t value = 0;
    for (int k = 0; k < kMaxVarintBytes; ++k) {
        const auto byte = bytes_.number<std::uint8_t>();
        // Ten bytes have 70 bits: the last one may only hold bit 63.
        if (k == kMaxVarintBytes - 1 && byte > 1) break;
        value |= std::uint64_t{byte & 0x7Fu} << (7 * k);
        if (byte < 0x80) {
            require(byte != 0 || k == 0);  // only the shortest form is valid
            return hasFailed() ? 0 : value;
        }
    }
    require(false);
    return 0;
}

void WireReader::flag(bool& value) {
    const auto byte = bytes_.number<std::uint8_t>();
    require(byte <= 1);
    value = byte == 1;
}

ByteView WireReader::counted(std::size_t maxBytes) {
    const std::uint64_t size = varint();
    require(size <= maxBytes);
    return hasFailed() ? ByteView() : bytes_.take(static_cast<std::size_t>(size));
}

void WireReader::text(std::string& value, std::size_t maxBytes) {
    const ByteView bytes = counted(maxBytes);
    value.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    require(isPlainText(value));
}

void WireReader::data(Bytes& value, std::size_t maxBytes) {
    const ByteView bytes = counted(maxBytes);
    value.assign(bytes.begin(), bytes.end());
}

}  // namespace terrane::net
