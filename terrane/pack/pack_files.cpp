#include "terrane/pack/pack_files.h"

#include <sodium.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/platform.h"
#include "terrane/store/chunks/bytes.h"

namespace terrane::pack {

namespace {

constexpr zip_int64_t kMaxEntries = 65536;

struct CloseZip {
    void operator()(zip_t* zip) const { zip_discard(zip); }
};
struct CloseFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Zip = std::unique_ptr<zip_t, CloseZip>;

std::string textOf(int code) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
}

base::Result<Zip> openZip(std::string_view bytes, const std::string& where) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* zip = source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
    if (!zip && source) zip_source_free(source);
    const int code = zip_error_code_zip(&error);
    zip_error_fini(&error);
    if (!zip)
        return base::fail(base::ErrorCode::BadInput, "{}: not a zip file of a content pack: {}", where,
                          textOf(code));
    return Zip(zip);
}

// "isles/" if pack.toml is in a folder of the zip file, else empty.
std::string folderOf(zip_t* zip, zip_int64_t count) {
    for (zip_int64_t k = 0; k < count; ++k) {
        const char* name = zip_get_name(zip, static_cast<zip_uint64_t>(k), 0);
        const std::string path = name ? name : "";
        if (path == "pack.toml") return {};
        const auto slash = path.find('/');
        if (slash != std::string::npos && path.substr(slash + 1) == "pack.toml")
            return path.substr(0, slash + 1);
    }
    return {};
}

base::Result<std::string> readEntry(zip_t* zip, zip_uint64_t index, std::size_t maxBytes,
                                    const std::string& where) {
    const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(zip, index, 0));
    if (!file)
        return base::fail(base::ErrorCode::BadInput, "{}: cannot be read: {}", where, zip_strerror(zip));
    std::string data;
    char buffer[16384];
    while (true) {
        const zip_int64_t read = zip_fread(file.get(), buffer, sizeof(buffer));
        if (read < 0)
            return base::fail(base::ErrorCode::BadInput, "{}: cannot be read: {}", where,
                              zip_file_strerror(file.get()));
        if (read == 0) return data;
        if (data.size() + static_cast<std::size_t>(read) > maxBytes)
            return base::fail(base::ErrorCode::BadInput, "{}: the pack has more than {} MiB", where,
                              kMaxPackBytes >> 20);
        data.append(buffer, static_cast<std::size_t>(read));
    }
}

}  // namespace

base::Result<PackFiles> readZipBytes(std::string_view bytes, const std::string& where) {
    auto zip = TERRANE_TRY(openZip(bytes, where));
    const zip_int64_t count = zip_get_num_entries(zip.get(), 0);
    if (count > kMaxEntries)
        return base::fail(base::ErrorCode::BadInput, "{}: more than {} files", where, kMaxEntries);
    const std::string folder = folderOf(zip.get(), count);
    PackFiles files;
    std::size_t total = 0;
    for (zip_int64_t k = 0; k < count; ++k) {
        const auto index = static_cast<zip_uint64_t>(k);
        const char* name = zip_get_name(zip.get(), index, 0);
        std::string path = name ? name : "";
        if (!path.starts_with(folder)) continue;
        path.erase(0, folder.size());
        if (!isPackPath(path) || files.contains(path)) continue;
        if (files.size() == kMaxFiles)
            return base::fail(base::ErrorCode::BadInput, "{}: more than {} files", where, kMaxFiles);
        auto data = TERRANE_TRY(readEntry(zip.get(), index, kMaxPackBytes - total, where + "/" + path));
        total += data.size();
        files.emplace(std::move(path), std::move(data));
    }
    return files;
}

base::Result<PackFiles> readZip(const std::filesystem::path& path) {
    const auto bytes = TERRANE_TRY(base::readFile(path, kMaxPackBytes));
    return readZipBytes(bytes, path.string());
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListedPacks = 1000;

base::Result<void> addFile(PackFiles& files, std::size_t& bytes, const fs::path& file, std::string path) {
    if (files.size() == kMaxFiles)
        return base::fail(base::ErrorCode::BadInput, "{}: more than {} files", file.parent_path().string(),
                          kMaxFiles);
    auto data = TERRANE_TRY(base::readFile(file, kMaxPackBytes - bytes));
    bytes += data.size();
    files.emplace(std::move(path), std::move(data));
    return {};
}

// Adds the files of one folder of a pack; `inside`: its path in the pack, "" or "textures/".
base::Result<void> addFolder(PackFiles& files, std::size_t& bytes, const fs::path& folder,
                             const std::string& inside) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string path = inside + it->path().filename().string();
        if (!isPackPath(path)) continue;
        TERRANE_TRY(addFile(files, bytes, it->path(), path));
    }
    if (error == std::errc::no_such_file_or_directory && !inside.empty()) return {};
    if (error)
        return base::fail("{}: cannot be read as a content pack: {}", folder.string(), error.message());
    return {};
}

base::Result<Pack> readFolder(const fs::path& folder) {
    PackFiles files;
    std::size_t bytes = 0;
    for (const char* inside : {"", "textures/", "generators/", "scripts/", "languages/"})
        TERRANE_TRY(addFolder(files, bytes, folder / inside, inside));
    return makePack(std::move(files), folder.string());
}

}  // namespace

base::Result<Pack> readPack(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return readFolder(path);
    auto files = TERRANE_TRY(readZip(path));
    return makePack(std::move(files), path.string());
}

base::Result<fs::path> findPack(std::string_view nameOrPath, std::span<const fs::path> folders) {
    std::error_code ignored;
    const fs::path given(nameOrPath);
    if (given.has_parent_path() || nameOrPath.ends_with(".zip") || !isPackName(nameOrPath)) {
        if (fs::exists(given, ignored)) return given;
        return base::fail(base::ErrorCode::NotFound, "there is no content pack \"{}\"", nameOrPath);
    }
    if (folders.empty())
        return base::fail(base::ErrorCode::NotFound,
                          "there is no content pack \"{}\", as there is no folder of packs: set {}",
                          nameOrPath, base::platform::dataFolderVariables());
    std::string looked;
    for (const fs::path& folder : folders) {
        for (const std::string& name : {std::string(nameOrPath), std::string(nameOrPath) + ".zip"})
            if (fs::exists(folder / name, ignored)) return folder / name;
        looked += (looked.empty() ? "" : ", ") + folder.string();
    }
    return base::fail(base::ErrorCode::NotFound,
                      "there is no content pack \"{}\" in {}; a path has a slash: ./{}", nameOrPath, looked,
                      nameOrPath);
}

std::vector<fs::path> packsIn(const fs::path& folder) {
    std::vector<fs::path> packs;
    std::error_code error;
    std::size_t seen = 0;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && seen < kMaxListedPacks;
         it.increment(error), ++seen) {
        const fs::path& path = it->path();
        const bool isPack = path.extension() == ".zip" || fs::exists(path / "pack.toml", error);
        if (isPack) packs.push_back(path);
    }
    std::ranges::sort(packs);
    return packs;
}

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
        if (!isPackPath(path) || path.starts_with(kScripts)) return wrong("a file that packs do not have");
        if (!files.empty() && path <= files.rbegin()->first) return wrong("files out of order");
        files.emplace_hint(files.end(), std::move(path), std::move(data));
    }
    if (!reader.rest().empty()) return wrong("bytes after its end");
    return files;
}

}  // namespace

PackHash hashOf(const Pack& pack) {
    const store::Bytes raw = rawBytes(clientFiles(pack.files));
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
    const store::Bytes raw = rawBytes(clientFiles(pack.files));
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
