// Reads and writes the values of messages (docs/protocol.md). WireWriter and WireReader have the same
// functions, so one template describes a message in both directions (message_codec.h).
//
// A reader accepts any bytes: after the first invalid value it fails and returns zeros. It allocates no more
// than a few times its input. Plain classes; one thread at a time for each object.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/world/coords.h"
#include "terrane/world/pose.h"

namespace terrane::net {

using store::Bytes;
using store::ByteView;

// Varint: seven bits per byte, lowest first; the highest bit says that more follow. 64 bits take 10 bytes.
constexpr int kMaxVarintBytes = 10;

// Maps 0, -1, 1, -2, … to 0, 1, 2, 3, …, so that numbers near zero are short.
constexpr std::uint64_t zigzag(std::int64_t value) {
    return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t value) {
    return static_cast<std::int64_t>(value >> 1 ^ (0 - (value & 1)));
}

class WireWriter {
  public:
    static constexpr bool kReads = false;

    explicit WireWriter(Bytes& bytes) : bytes_(bytes) {}

    // As many bytes as the type has, little-endian.
    template <class T>
    void fixed(const T& value) {
        store::appendNumber(bytes_, value);
    }
    void number(std::uint64_t value);                                   // varint
    void integer(std::int64_t value) { number(zigzag(value)); }         // varint of zigzag
    void flag(bool value) { fixed(static_cast<std::uint8_t>(value)); }  // a byte, 0 or 1
    template <class E>
    void choice(E value, E /*count*/) {  // a byte below `count`
        fixed(static_cast<std::uint8_t>(value));
    }
    void text(const std::string& value, std::size_t /*maxBytes*/) { bytes(std::as_bytes(std::span(value))); }
    void data(const Bytes& value, std::size_t /*maxBytes*/) { bytes(value); }
    template <std::size_t N>
    void array(const std::array<std::byte, N>& value) {
        store::append(bytes_, value);
    }
    // A count, then the values, each written by `each`.
    template <class T, class Each>
    void list(const std::vector<T>& values, std::size_t /*maxCount*/, Each each) {
        number(values.size());
        for (const T& value : values) each(value);
    }
    template <class T, class Each>
    void optional(const std::optional<T>& value, Each each) {
        flag(value.has_value());
        if (value) each(*value);
    }
    void require(bool /*holds*/) {}
    void ignoreRest() {}

  private:
    void bytes(ByteView value);

    Bytes& bytes_;
};

class WireReader {
  public:
    static constexpr bool kReads = true;

    explicit WireReader(ByteView bytes) : bytes_(bytes) {}

    template <class T>
    void fixed(T& value) {
        value = bytes_.number<T>();
    }
    // Fails if the number is too large for the type.
    template <class T>
    void number(T& value) {
        static_assert(std::is_unsigned_v<T>);
        const std::uint64_t read = varint();
        require(read <= std::uint64_t{static_cast<T>(-1)});
        value = hasFailed() ? 0 : static_cast<T>(read);
    }
    template <class T>
    void integer(T& value) {
        static_assert(std::is_signed_v<T>);
        const std::int64_t read = unzigzag(varint());
        require(read == std::int64_t{static_cast<T>(read)});
        value = hasFailed() ? 0 : static_cast<T>(read);
    }
    void flag(bool& value);
    template <class E>
    void choice(E& value, E count) {
        const auto read = bytes_.number<std::uint8_t>();
        require(read < static_cast<std::uint8_t>(count));
        value = hasFailed() ? E{} : static_cast<E>(read);
    }
    void text(std::string& value, std::size_t maxBytes);  // isPlainText()
    void data(Bytes& value, std::size_t maxBytes);
    template <std::size_t N>
    void array(std::array<std::byte, N>& value) {
        bytes_.copyTo(value);
    }
    template <class T, class Each>
    void list(std::vector<T>& values, std::size_t maxCount, Each each) {
        values.clear();
        const std::uint64_t count = varint();
        // Every value takes at least a byte: larger counts are invalid.
        require(count <= maxCount && count <= bytes_.rest().size());
        for (std::uint64_t k = 0; k < count && !hasFailed(); ++k) each(values.emplace_back());
    }
    template <class T, class Each>
    void optional(std::optional<T>& value, Each each) {
        bool has = false;
        flag(has);
        if (has) each(value.emplace());
    }
    // An additional condition for a valid message.
    void require(bool holds) { isWrong_ |= !holds; }
    // Skips all remaining bytes.
    void ignoreRest() { bytes_.take(bytes_.rest().size()); }

    bool hasFailed() const { return isWrong_ || bytes_.isPastEnd(); }
    // Whether all bytes were read and valid.
    bool isComplete() const { return !hasFailed() && bytes_.rest().empty(); }

  private:
    std::uint64_t varint();
    ByteView counted(std::size_t maxBytes);

    store::ByteReader bytes_;
    bool isWrong_ = false;
};

// Wire formats of chunk positions and poses: positions in steps of 1/64 block, directions in 1/65536 turn,
// those of other players in 1/256 turn. Plain values and functions; any thread.
constexpr double kPoseSteps = 64;                                 // steps per block
constexpr std::int64_t kMaxPosePosition = std::int64_t{1} << 37;  // in steps, either way
constexpr int kPitchStep = 258;  // units of WirePose::pitch per unit of PoseChange::pitch

// A player's pose. Position in steps; blocks are at most 2^31 away, so it fits 38 bits.
struct WirePose {
    std::int64_t x = 0, y = 0, z = 0;
    std::uint16_t yaw = 0;   // 65536 a turn
    std::int16_t pitch = 0;  // 32767 for straight up
    bool operator==(const WirePose&) const = default;
};

inline bool isInRange(const WirePose& pose) {
    const auto isGood = [](std::int64_t v) { return v >= -kMaxPosePosition && v <= kMaxPosePosition; };
    return isGood(pose.x) && isGood(pose.y) && isGood(pose.z);
}

WirePose wirePose(const world::Pose& pose);
world::Pose poseOf(const WirePose& pose);
// In blocks.
double distanceBetween(const WirePose& a, const WirePose& b);

// Movement of another player since its last transmitted pose.
struct PoseChange {
    std::uint16_t slot = 0;
    std::int64_t dx = 0, dy = 0, dz = 0;  // in steps; may be large after teleports
    std::uint8_t yaw = 0;                 // 256 a turn
    std::int8_t pitch = 0;                // 127 for straight up
    bool swings = false;                  // broke or placed a block since
    bool operator==(const PoseChange&) const = default;
};

// A chunk position: level as a byte, then x and y as integers.
template <class Wire, class Pos>
void describeChunkPos(Wire& wire, Pos& pos) {
    wire.fixed(pos.level);
    wire.integer(pos.x);
    wire.integer(pos.y);
    wire.require(pos.level <= world::kMaxLevel && world::isInWorld(pos));
}

template <class Wire, class Pose>
void describePose(Wire& wire, Pose& pose) {
    wire.integer(pose.x);
    wire.integer(pose.y);
    wire.integer(pose.z);
    wire.fixed(pose.yaw);
    wire.fixed(pose.pitch);
    for (const std::int64_t v : {pose.x, pose.y, pose.z})
        wire.require(v >= -kMaxPosePosition && v <= kMaxPosePosition);
}

// Text that players and servers send each other: names, chat, reasons. Pure functions, for any thread.
// Whether the text is UTF-8 without characters that end or reorder lines (base/printable.h).
bool isPlainText(std::string_view text);
// Escapes any text so that isPlainText() holds, and cuts it to `maxBytes` at a character.
std::string plainText(std::string_view text, std::size_t maxBytes);

// Message framing in a byte stream: each message is its length as a varint, then its bytes
// (docs/protocol.md). Plain values; one thread at a time for each object.
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
