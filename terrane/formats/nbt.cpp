#include "terrane/formats/nbt.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <new>
#include <type_traits>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::formats {

namespace {

constexpr int kAnyWindow = 15 + 32;   // zlib or gzip, as the header says
constexpr int kGzipWindow = 15 + 16;  // gzip
constexpr int kMemoryLevel = 8;       // zlib's default
constexpr std::size_t kPieceBytes = std::size_t{64} << 10;

const Bytef* inputOf(std::string_view bytes) {
    return reinterpret_cast<const Bytef*>(bytes.data());
}

struct Inflater {
    z_stream stream{};

    Inflater() {
        if (inflateInit2(&stream, kAnyWindow) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

base::Result<std::string> inflate(std::string_view bytes, std::size_t maxBytes) {
    if (bytes.size() > UINT32_MAX)
        return base::fail(base::ErrorCode::OutOfResources, "{} compressed bytes are too many", bytes.size());
    Inflater inflater;
    z_stream& stream = inflater.stream;
    stream.next_in = inputOf(bytes);
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string out;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        const std::size_t done = out.size();
        if (done > maxBytes)
            return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes when decompressed",
                              maxBytes);
        out.resize(done + kPieceBytes);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
        stream.avail_out = static_cast<uInt>(kPieceBytes);
        status = ::inflate(&stream, Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
        const bool isStuck = status == Z_BUF_ERROR || (status == Z_OK && out.size() == done);
        if (isStuck) return base::fail(base::ErrorCode::Damaged, "the compressed data are cut off");
        if (status != Z_OK && status != Z_STREAM_END)
            return base::fail(base::ErrorCode::Damaged, "the compressed data are damaged");
    }
    if (out.size() > maxBytes)
        return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes when decompressed", maxBytes);
    return out;
}

std::string inflateStart(std::string_view bytes, std::size_t maxBytes) {
    Inflater inflater;
    z_stream& stream = inflater.stream;
    stream.next_in = inputOf(bytes);
    stream.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), UINT32_MAX));
    std::string out;
    for (int status = Z_OK; status == Z_OK && out.size() < maxBytes;) {
        const std::size_t done = out.size(), piece = std::min(kPieceBytes, maxBytes - done);
        out.resize(done + piece);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
        stream.avail_out = static_cast<uInt>(piece);
        status = ::inflate(&stream, Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
    }
    return out;
}

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::string out;
    std::size_t taken = 0;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        if (stream.avail_in == 0 && taken < bytes.size()) {
            const std::size_t piece = std::min(bytes.size() - taken, std::size_t{1} << 30);
            stream.next_in = inputOf(bytes.substr(taken));
            stream.avail_in = static_cast<uInt>(piece);
            taken += piece;
        }
        const std::size_t done = out.size();
        out.resize(done + kPieceBytes);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
        stream.avail_out = static_cast<uInt>(kPieceBytes);
        status = ::deflate(&stream, taken == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    return out;
}

namespace {

constexpr std::uint8_t kNbtCompoundType = 10;
constexpr std::size_t kNbtTypes = std::variant_size_v<NbtTag::Value>;

template <class T>
using BitsOf =
    std::conditional_t<sizeof(T) == 1, std::uint8_t,
                       std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                          std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

// Reads until something is wrong; then `problem_` has the reason and all further reads give nothing.
class NbtReader {
  public:
    explicit NbtReader(std::string_view bytes) : bytes_(bytes) {}

    base::Result<NbtRoot> root() {
        if (number<std::uint8_t>() != kNbtCompoundType) wrong("expected a compound");
        NbtRoot root;
        root.name = text();
        root.compound = compound(1);
        if (!problem_.empty())
            return base::fail(base::ErrorCode::Damaged, "NBT, byte {}: {}", problemAt_, problem_);
        return root;
    }

  private:
    void wrong(std::string_view problem) {
        if (!problem_.empty()) return;
        problem_ = problem;
        problemAt_ = at_;
        bytes_ = bytes_.substr(0, at_);
    }

    std::size_t left() const { return bytes_.size() - at_; }

    bool has(std::size_t count) {
        if (left() >= count && problem_.empty()) return true;
        wrong("the data are cut off");
        return false;
    }

    template <class T>
    T number() {
        if (!has(sizeof(T))) return T{};
        BitsOf<T> bits = 0;
        for (std::size_t k = 0; k < sizeof(T); ++k)
            bits =
                static_cast<BitsOf<T>>(std::uint64_t{bits} << 8 | static_cast<std::uint8_t>(bytes_[at_ + k]));
        at_ += sizeof(T);
        return std::bit_cast<T>(bits);
    }

    std::string text() {
        const std::size_t size = number<std::uint16_t>();
        if (!has(size)) return {};
        at_ += size;
        return std::string(bytes_.substr(at_ - size, size));
    }

    // The number of elements that follow; each takes at least `elementBytes`.
    std::size_t count(std::size_t elementBytes) {
        const auto value = number<std::int32_t>();
        if (value <= 0) return 0;  // Minecraft takes a negative length of a list for 0
        if (static_cast<std::size_t>(value) > left() / elementBytes) {
            wrong("the data are cut off");
            return 0;
        }
        return static_cast<std::size_t>(value);
    }

    template <class T>
    std::vector<T> array() {
        std::vector<T> values(count(sizeof(T)));
        for (T& value : values) value = number<T>();
        return values;
    }

    NbtBytes byteArray() {
        const std::size_t size = count(1);
        at_ += size;
        return {std::string(bytes_.substr(at_ - size, size))};
    }

    NbtList list(int depth) {
        NbtList list;
        list.type = number<std::uint8_t>();
        const std::size_t size = count(1);
        if (list.type == 0 && size > 0) wrong("a list without a type that is not empty");
        for (std::size_t k = 0; k < size && problem_.empty(); ++k) list.tags.push_back(tag(list.type, depth));
        return list;
    }

    NbtCompound compound(int depth) {
        NbtCompound compound;
        while (problem_.empty()) {
            const auto type = number<std::uint8_t>();
            if (type == 0) break;
            std::string name = text();
            compound.entries.push_back({std::move(name), tag(type, depth)});
        }
        return compound;
    }

    NbtTag tag(std::uint8_t type, int depth) {
        if (++tags_ > kMaxNbtTags) wrong("too many tags");
        if (depth >= kMaxNbtDepth) wrong("nested too deep");
        if (!problem_.empty()) return {};
        switch (type) {
            case 1:
                return {number<std::int8_t>()};
            case 2:
                return {number<std::int16_t>()};
            case 3:
                return {number<std::int32_t>()};
            case 4:
                return {number<std::int64_t>()};
            case 5:
                return {number<float>()};
            case 6:
                return {number<double>()};
            case 7:
                return {byteArray()};
            case 8:
                return {text()};
            case 9:
                return {list(depth + 1)};
            case 10:
                return {compound(depth + 1)};
            case 11:
                return {array<std::int32_t>()};
            case 12:
                return {array<std::int64_t>()};
            default:
                wrong("a tag of an unknown type");
                return {};
        }
    }

    std::string_view bytes_;
    std::size_t at_ = 0, tags_ = 0, problemAt_ = 0;
    std::string problem_;
};

class NbtWriter {
  public:
    std::string take() { return std::move(out_); }

    template <class T>
    requires std::is_arithmetic_v<T>
    void write(T value) {
        const auto bits = std::bit_cast<BitsOf<T>>(value);
        for (std::size_t k = sizeof(T); k-- > 0;) out_.push_back(static_cast<char>(bits >> (8 * k)));
    }
    void write(NbtEnd) {}
    void write(const NbtBytes& bytes) {
        write(static_cast<std::int32_t>(bytes.bytes.size()));
        out_ += bytes.bytes;
    }
    void write(const std::string& text) {
        base::require(text.size() <= UINT16_MAX, "encodeNbt: a text has more than 65,535 bytes");
        write(static_cast<std::uint16_t>(text.size()));
        out_ += text;
    }
    void write(const NbtList& list) {
        write(list.type);
        write(static_cast<std::int32_t>(list.tags.size()));
        for (const NbtTag& tag : list.tags) {
            base::require(tag.value.index() == list.type, "encodeNbt: a tag is not of its list's type");
            write(tag);
        }
    }
    void write(const NbtCompound& compound) {
        for (const NbtEntry& entry : compound.entries) {
            write(static_cast<std::uint8_t>(entry.tag.value.index()));
            write(entry.name);
            write(entry.tag);
        }
        write(std::uint8_t{0});
    }
    template <class T>
    void write(const std::vector<T>& values) {
        write(static_cast<std::int32_t>(values.size()));
        for (const T value : values) write(value);
    }
    void write(const NbtTag& tag) {
        std::visit([this](const auto& value) { write(value); }, tag.value);
    }

  private:
    std::string out_;
};

}  // namespace

bool NbtList::operator==(const NbtList& other) const {
    return type == other.type && tags == other.tags;
}

bool NbtCompound::operator==(const NbtCompound& other) const {
    return entries == other.entries;
}

const NbtTag* NbtCompound::find(std::string_view name) const {
    for (const NbtEntry& entry : entries)
        if (entry.name == name) return &entry.tag;
    return nullptr;
}

std::optional<std::int64_t> NbtCompound::integer(std::string_view name) const {
    const NbtTag* tag = find(name);
    if (!tag) return std::nullopt;
    return std::visit(
        [](const auto& value) -> std::optional<std::int64_t> {
            if constexpr (std::is_integral_v<std::decay_t<decltype(value)>>) return std::int64_t{value};
            return std::nullopt;
        },
        tag->value);
}

NbtCompound& NbtCompound::add(std::string_view name, NbtTag tag) {
    entries.push_back({std::string(name), std::move(tag)});
    return *this;
}

base::Result<NbtRoot> decodeNbt(std::string_view bytes) {
    static_assert(kNbtTypes == 13, "types 0 to 12");
    return NbtReader(bytes).root();
}

std::string encodeNbt(const NbtRoot& root) {
    NbtWriter writer;
    writer.write(kNbtCompoundType);
    writer.write(root.name);
    writer.write(root.compound);
    return writer.take();
}

}  // namespace terrane::formats
