#include "terrane/pack/zip_file.h"

#include <zip.h>

#include <memory>
#include <string>

#include "terrane/base/files.h"

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

}  // namespace terrane::pack
