#include "terrane/base/files.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace terrane::base {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

tl::unexpected<Error> cannotWrite(const std::filesystem::path& path, int errorNumber) {
    return fail(ErrorCode::Io, "{}: cannot be written: {}", path.string(), systemReason(errorNumber));
}

struct TemporaryFile {
    File file;
    std::filesystem::path path;
};

// Opened exclusively under a name nobody uses yet, so that two writers of one path never share a temporary
// file.
Result<TemporaryFile> openBeside(const std::filesystem::path& path) {
    constexpr int kMaxAttempts = 1000;  // far more than writers at once and leftovers of crashes together
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
        std::filesystem::path temporary = path;
        temporary += fmt::format(".tmp{}", attempt);
        if (File file{std::fopen(temporary.c_str(), "wbx")}) {
            return TemporaryFile{std::move(file), std::move(temporary)};
        }
        if (errno != EEXIST) return cannotWrite(path, errno);
    }
    return fail(ErrorCode::Io, "{}: cannot be written: delete the old files {}.tmp* beside it", path.string(),
                path.filename().string());
}

// Zero, or the error number. fclose can be the one to report a full disk.
int writeAndClose(File file, std::string_view bytes) {
    assert(file && "an open file is written");
    errno = 0;
    const std::size_t writtenBytes = std::fwrite(bytes.data(), 1, bytes.size(), file.get());
    const int writeError = writtenBytes == bytes.size() ? 0 : errno != 0 ? errno : EIO;
    const int closeError = std::fclose(file.release()) == 0 ? 0 : errno;
    return writeError != 0 ? writeError : closeError;
}

// Also to what is not there yet. A link still, where they lead in a circle.
std::filesystem::path behindLinks(std::filesystem::path file) {
    constexpr int kMaxLinks = 40;  // as the system follows
    std::error_code ignored;
    for (int k = 0; k < kMaxLinks && std::filesystem::is_symlink(file, ignored); ++k) {
        file = file.parent_path() / std::filesystem::read_symlink(file, ignored);
    }
    return file;
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path) {
    const File file{std::fopen(path.c_str(), "rb")};
    if (!file) return fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), systemReason(errno));
    std::string bytes;
    std::array<char, 65536> part;
    while (const std::size_t partBytes = std::fread(part.data(), 1, part.size(), file.get())) {
        bytes.append(part.data(), partBytes);
    }
    if (std::ferror(file.get()) != 0)
        return fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), systemReason(errno));
    return bytes;
}

Result<void> writeFile(const std::filesystem::path& given, std::string_view bytes) {
    std::error_code ignored;
    const std::filesystem::path path = behindLinks(given);
    if (std::filesystem::is_symlink(path, ignored)) return cannotWrite(given, ELOOP);
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status)) return cannotWrite(path, EISDIR);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        return fail(ErrorCode::Io, "{}: cannot be written: it is not a regular file", path.string());
    }
    Result<TemporaryFile> temporary = openBeside(path);
    if (!temporary) return tl::unexpected(temporary.error());
    int errorNumber = writeAndClose(std::move(temporary->file), bytes);
    if (errorNumber == 0 && std::rename(temporary->path.c_str(), path.c_str()) != 0) errorNumber = errno;
    if (errorNumber == 0) return {};
    std::filesystem::remove(temporary->path, ignored);
    return cannotWrite(path, errorNumber);
}

}  // namespace terrane::base
