#include "terrane/net/wire/wire.h"

#include <algorithm>
#include <cmath>

#include "terrane/base/text.h"

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

namespace {

constexpr double kFullTurn = 65536, kStraightUp = 32767;

std::int64_t steps(double blocks) {
    return std::llround(blocks * kPoseSteps);
}

}  // namespace

WirePose wirePose(const world::Pose& pose) {
    const glm::dvec3& p = pose.position;
    const long long turn = std::llround(double{pose.yaw} / 360 * kFullTurn);
    const double up = std::clamp(double{pose.pitch} / 90, -1.0, 1.0) * kStraightUp;
    return {steps(p.x), steps(p.y), steps(p.z), static_cast<std::uint16_t>(turn & 0xFFFF),
            static_cast<std::int16_t>(std::lround(up))};
}

double distanceBetween(const WirePose& a, const WirePose& b) {
    const auto dx = static_cast<double>(a.x - b.x), dy = static_cast<double>(a.y - b.y),
               dz = static_cast<double>(a.z - b.z);
    return std::sqrt(dx * dx + dy * dy + dz * dz) / kPoseSteps;
}

world::Pose poseOf(const WirePose& pose) {
    const auto blocks = [](std::int64_t v) { return static_cast<double>(v) / kPoseSteps; };
    return {{blocks(pose.x), blocks(pose.y), blocks(pose.z)},
            static_cast<float>(pose.yaw / kFullTurn * 360),
            static_cast<float>(pose.pitch / kStraightUp * 90)};
}

bool isPlainText(std::string_view text) {
    return base::printable(text) == text;
}

std::string plainText(std::string_view text, std::size_t maxBytes) {
    std::string line = base::printable(text);
    if (line.size() <= maxBytes) return line;
    // Cut at a character boundary.
    std::size_t end = maxBytes;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
    line.resize(end);
    return line;
}

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
