#include "terrane/pack/pack_archive.h"

#include <sodium.h>

#include <utility>

#include "terrane/store/compression.h"

namespace terrane::pack {
namespace {

constexpr std::uint32_t kMagic = 0x314B5054;  // "TPK1"
// The contents, and paths and lengths of kMaxFiles files.
constexpr std::size_t kMaxRawBytes = kMaxPackBytes + kMaxFiles * 256;

// A count, then for each file the length of its path, the length of its contents, path and contents; in order
// of paths.
store::Bytes rawBytes(const PackFiles& files) {
    store::Bytes bytes;
    store::appendNumber(bytes, static_cast<std::uint32_t>(files.size()));
    for (const auto& [path, data] : files) {
        store::appendNumber(bytes, static_cast<std::uint16_t>(path.size()));
        store::appendNumber(bytes, static_cast<std::uint32_t>(data.size()));
        store::append(bytes, std::as_bytes(std::span(path)));
        store::append(bytes, std::as_bytes(std::span(data)));
    }
    return bytes;
}

std::string textOf(store::ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

base::Result<PackFiles> filesOf(store::ByteView raw, const std::string& where) {
    const auto wrong = [&](std::string_view what) {
        return base::fail(base::ErrorCode::BadInput, "{}: not an archive of a content pack: {}", where, what);
    };
    store::ByteReader reader(raw);
    PackFiles files;
    const auto count = reader.number<std::uint32_t>();
    if (count > kMaxFiles) return wrong("too many files");
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto pathLength = reader.number<std::uint16_t>();
        const auto dataLength = reader.number<std::uint32_t>();
        std::string path = textOf(reader.take(pathLength));
        std::string data = textOf(reader.take(dataLength));
        if (reader.isPastEnd()) return wrong("it ends too early");
        if (!isPackPath(path)) return wrong("a file that packs do not have");
        if (!files.empty() && path <= files.rbegin()->first) return wrong("files out of order");
        files.emplace_hint(files.end(), std::move(path), std::move(data));
    }
    if (!reader.rest().empty()) return wrong("bytes after its end");
    return files;
}

}  // namespace

PackHash hashOf(const Pack& pack) {
    const store::Bytes raw = rawBytes(pack.files);
    PackHash hash{};
    crypto_hash_sha256(reinterpret_cast<unsigned char*>(hash.data()),
                       reinterpret_cast<const unsigned char*>(raw.data()), raw.size());
    return hash;
}

std::string hexOf(const PackHash& hash) {
    std::string text;
    for (const std::byte byte : hash) text += fmt::format("{:02x}", std::to_integer<int>(byte));
    return text;
}

store::Bytes archiveOf(const Pack& pack) {
    const store::Bytes raw = rawBytes(pack.files);
    store::Bytes archive;
    store::appendNumber(archive, kMagic);
    store::appendNumber(archive, static_cast<std::uint32_t>(raw.size()));
    store::appendCompressed(archive, raw);
    return archive;
}

base::Result<Pack> packOf(store::ByteView archive, const std::string& where) {
    store::ByteReader reader(archive);
    const auto magic = reader.number<std::uint32_t>();
    const auto size = reader.number<std::uint32_t>();
    if (magic != kMagic || reader.isPastEnd())
        return base::fail(base::ErrorCode::BadInput, "{}: not an archive of a content pack", where);
    if (size > kMaxRawBytes)
        return base::fail(base::ErrorCode::BadInput, "{}: the pack has more than {} MiB", where,
                          kMaxPackBytes >> 20);
    store::Bytes raw(size);
    if (auto done = store::decompress(reader.rest(), raw); !done)
        return base::fail(base::ErrorCode::BadInput, "{}: not an archive of a content pack: {}", where,
                          done.error().message);
    auto files = TERRANE_TRY(filesOf(raw, where));
    return makePack(std::move(files), where);
}

}  // namespace terrane::pack
