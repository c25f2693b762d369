// NBT, the tree of tags in which Minecraft and its tools store data, uncompressed and big-endian. It is used
// by schematic.h and with region_file.h. All are plain values; any thread may use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::formats {

// Reads and writes zlib and gzip data. It is called by the readers and writers of this module. The functions
// have no state; any thread may call them. Decompresses zlib or gzip, recognized by the first bytes; bytes
// after the end of the stream are ignored. Returns Damaged if the stream is broken or cut off, OutOfResources
// if it holds more than `maxBytes`. Messages name no file.
[[nodiscard]] base::Result<std::string> inflate(std::string_view bytes, std::size_t maxBytes);

// The beginning of the decompressed data, at most `maxBytes`: as far as the stream is whole. Empty if it is
// none.
[[nodiscard]] std::string inflateStart(std::string_view bytes, std::size_t maxBytes);

// Compresses to one gzip member without name and time, so that equal bytes give equal files (with one version
// of zlib).
[[nodiscard]] std::string gzip(std::string_view bytes);

struct NbtTag;
struct NbtEntry;

struct NbtEnd {  // the type of empty lists
    bool operator==(const NbtEnd&) const = default;
};
struct NbtBytes {
    std::string bytes;
    bool operator==(const NbtBytes&) const = default;
};
struct NbtList {
    std::uint8_t type = 0;  // of all tags: the index in NbtTag::Value
    std::vector<NbtTag> tags;
    bool operator==(const NbtList& other) const;
};
struct NbtCompound {
    std::vector<NbtEntry> entries;  // in the order of the file

    const NbtTag* find(std::string_view name) const;  // the first of that name; null if there is none
    // Returns the value of the first tag of that name; null if there is none or it has another type.
    template <class T>
    const T* get(std::string_view name) const;
    // Returns the value of a tag of any integer type.
    std::optional<std::int64_t> integer(std::string_view name) const;
    NbtCompound& add(std::string_view name, NbtTag tag);  // returns itself, for chaining
    bool operator==(const NbtCompound& other) const;
};

struct NbtTag {
    // The index is the type's number in the file.
    using Value =
        std::variant<NbtEnd, std::int8_t, std::int16_t, std::int32_t, std::int64_t, float, double, NbtBytes,
                     std::string, NbtList, NbtCompound, std::vector<std::int32_t>, std::vector<std::int64_t>>;
    Value value;

    bool operator==(const NbtTag& other) const { return value == other.value; }
};

struct NbtEntry {
    std::string name;
    NbtTag tag;
    bool operator==(const NbtEntry&) const = default;
};

// The outermost tag is a compound with a name, mostly empty. Texts have the bytes of the file ("modified
// UTF-8").
struct NbtRoot {
    std::string name;
    NbtCompound compound;
    bool operator==(const NbtRoot&) const = default;
};

// Deeper files are refused; Minecraft writes about ten levels.
constexpr int kMaxNbtDepth = 64;
// 2^20 tags × 72 bytes = 72 MiB. Arrays count as one tag and are as large as in the file.
constexpr std::size_t kMaxNbtTags = std::size_t{1} << 20;

// Decodes a file. Bytes after the root are ignored, as Minecraft does. Errors name the byte at which the data
// are wrong.
[[nodiscard]] base::Result<NbtRoot> decodeNbt(std::string_view bytes);
// Encodes a file. Throws std::invalid_argument if a name or text has more than 65,535 bytes or a tag is not
// of its list's type.
[[nodiscard]] std::string encodeNbt(const NbtRoot& root);

template <class T>
const T* NbtCompound::get(std::string_view name) const {
    const NbtTag* tag = find(name);
    return tag ? std::get_if<T>(&tag->value) : nullptr;
}

}  // namespace terrane::formats
