#include "terrane/net/client/client_packs.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/platform.h"
#include "terrane/base/text.h"
#include "terrane/net/wire/wire.h"
#include "terrane/pack/installed_packs.h"
#include "terrane/pack/pack_files.h"

namespace terrane::net {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxCacheBytes = std::uintmax_t{512} << 20;

fs::path cacheFile(const ClientPacks& packs, const pack::PackHash& hash) {
    return packs.cache / (pack::hexOf(hash) + ".pack");
}

const HeldPack* packWith(const ClientPacks& packs, const pack::PackHash& hash) {
    const auto found = std::ranges::find(packs.packs, hash, &HeldPack::hash);
    return found == packs.packs.end() ? nullptr : &*found;
}

// Adds the pack, read from the player's packs or from the cache, if it has this hash.
bool addIfEqual(ClientPacks& packs, base::Result<pack::Pack> read, const pack::PackHash& hash) {
    if (!read || pack::hashOf(*read) != hash) return false;
    packs.packs.push_back({hash, std::move(*read)});
    return true;
}

std::size_t bytesOf(const pack::Pack& pack) {
    std::size_t bytes = 0;
    for (const auto& [path, data] : pack.files) bytes += data.size();
    return bytes;
}

// Gives the file the latest time in its folder, for pruneCache(): also after a wrong date, the file that was
// used last is the newest.
void markAsUsed(const fs::path& file) {
    std::error_code error;
    fs::file_time_type time = fs::file_time_type::clock::now();
    for (fs::directory_iterator it(file.parent_path(), error), end; !error && it != end;
         it.increment(error)) {
        std::error_code unknown;
        const fs::file_time_type other = it->last_write_time(unknown);
        if (!unknown && it->path() != file) time = std::max(time, other + std::chrono::milliseconds(1));
    }
    fs::last_write_time(file, time, error);
}

bool findHere(ClientPacks& packs, const PackOffer& offer) {
    if (packWith(packs, offer.hash)) return true;
    const auto own = pack::isPackName(offer.name) ? pack::findPack(offer.name, pack::packFolders())
                                                  : base::Result<fs::path>(base::fail("no name of a pack"));
    if (own && addIfEqual(packs, pack::readPack(*own), offer.hash)) return true;
    if (packs.cache.empty()) return false;
    const fs::path file = cacheFile(packs, offer.hash);
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return false;
    const auto bytes = base::readFile(file);
    if (!bytes) return false;
    markAsUsed(file);
    return addIfEqual(packs, pack::packOf(std::as_bytes(std::span(*bytes)), file.string()), offer.hash);
}

// Deletes the least recently used files, by markAsUsed(), until the rest fits kMaxCacheBytes.
void pruneCache(const fs::path& folder) {
    struct CacheFile {
        fs::path path;
        fs::file_time_type time;
        std::uintmax_t bytes = 0;
    };
    std::vector<CacheFile> files;
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code unknown;
        const CacheFile file{it->path(), it->last_write_time(unknown), it->file_size(unknown)};
        if (unknown || !it->is_regular_file(unknown)) continue;
        files.push_back(file);
        bytes += file.bytes;
    }
    std::ranges::sort(files, {}, &CacheFile::time);
    for (const CacheFile& file : files) {
        if (bytes <= kMaxCacheBytes) return;
        fs::remove(file.path, error);
        bytes -= file.bytes;
    }
}

void writeToCache(const ClientPacks& packs, const PackOffer& offer, const store::Bytes& archive) {
    if (packs.cache.empty()) return;
    std::error_code error;
    fs::create_directories(packs.cache, error);
    const std::string_view bytes(reinterpret_cast<const char*>(archive.data()), archive.size());
    const auto file = cacheFile(packs, offer.hash);
    if (auto written = base::writeFile(file, bytes); !written)
        base::logWarning("the server's pack cannot be kept: {}", written.error().message);
    markAsUsed(file);
    pruneCache(packs.cache);
}

}  // namespace

fs::path packCacheFolder() {
    const fs::path cache = base::platform::userFolder(base::platform::UserFolder::Cache);
    return cache.empty() ? cache : cache / "terrane" / "packs";
}

base::Result<std::vector<std::uint8_t>> missingPacks(ClientPacks& packs, const WorldOffer& offer) {
    packs.missing.clear();
    std::vector<std::uint8_t> numbers;
    std::size_t bytes = 0;
    for (std::size_t k = 0; k < offer.packs.size(); ++k) {
        const PackOffer& pack = offer.packs[k];
        if (findHere(packs, pack)) continue;
        if (!packs.acceptsAll && std::ranges::find(packs.accepted, pack.hash) == packs.accepted.end())
            packs.missing.push_back(pack);
        numbers.push_back(static_cast<std::uint8_t>(k));
        bytes += pack.bytes;
    }
    if (bytes > kMaxServerPackBytes)
        return base::fail("the server's content packs are too large: {} MiB, at most {}", bytes >> 20,
                          kMaxServerPackBytes >> 20);
    if (!packs.missing.empty())
        return base::fail("the server's world needs content packs that are not installed: {}",
                          textOf(packs.missing));
    return numbers;
}

base::Result<void> takePack(ClientPacks& packs, const PackOffer& offer, const store::Bytes& archive) {
    if (packWith(packs, offer.hash)) return {};  // another connection of this program was faster
    auto pack = pack::packOf(archive, fmt::format("{} of the server", base::printable(offer.name)));
    if (!pack) return tl::unexpected(pack.error());
    if (pack::hashOf(*pack) != offer.hash)
        return base::fail("the server sent a different content pack than it offered: {}",
                          base::printable(offer.name));
    std::size_t bytes = bytesOf(*pack);
    for (const HeldPack& held : packs.packs) bytes += held.isSent ? bytesOf(held.pack) : 0;
    if (bytes > kMaxServerPackBytes)
        return base::fail("the server's content packs are too large: at most {} MiB",
                          kMaxServerPackBytes >> 20);
    packs.packs.push_back({offer.hash, std::move(*pack), true});
    writeToCache(packs, offer, archive);
    return {};
}

base::Result<pack::Content> contentOf(const ClientPacks& packs, const WorldOffer& offer) {
    std::vector<pack::Pack> ordered;
    for (const PackOffer& wanted : offer.packs) {
        const HeldPack* found = packWith(packs, wanted.hash);
        if (!found) return base::fail("the content pack {} is missing", base::printable(wanted.name));
        ordered.push_back(found->pack);
    }
    return pack::loadContent(std::move(ordered));
}

base::Result<ServerContent> serverContent(const pack::Content& content) {
    ServerContent offered{content.generators, {}};
    std::size_t bytes = 0;
    for (const pack::Pack& pack : *content.packs) {
        if (pack.info.name == pack::kBuiltInPack) continue;
        auto archive = std::make_shared<const store::Bytes>(pack::archiveOf(pack));
        bytes += bytesOf(pack);  // as clients count them
        offered.packs.push_back({{pack.info.name, plainText(pack.info.version, kMaxPackNameBytes),
                                  pack::hashOf(pack), static_cast<std::uint32_t>(archive->size())},
                                 archive});
    }
    if (offered.packs.size() > kMaxPacks || bytes > kMaxServerPackBytes)
        return base::fail("a server's world has at most {} content packs of {} MiB together, got {} of {}",
                          kMaxPacks, kMaxServerPackBytes >> 20, offered.packs.size(), bytes >> 20);
    return offered;
}

std::string textOf(std::span<const PackOffer> packs) {
    std::string text;
    for (const PackOffer& pack : packs)
        text += fmt::format("{}{}{}{} ({} KB)", text.empty() ? "" : ", ", base::printable(pack.name),
                            pack.version.empty() ? "" : " ", base::printable(pack.version),
                            (pack.bytes + 999) / 1000);
    return text;
}

}  // namespace terrane::net
