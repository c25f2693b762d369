#include "terrane/base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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
    int writeError = writtenBytes == bytes.size() ? 0 : errno != 0 ? errno : EIO;
    if (writeError == 0 && (std::fflush(file.get()) != 0 || ::fsync(::fileno(file.get())) != 0))
        writeError = errno;
    const int closeError = std::fclose(file.release()) == 0 ? 0 : errno;
    return writeError != 0 ? writeError : closeError;
}

// So that a file's new name survives the power's end. File systems that cannot do it are left to themselves.
void syncFolder(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
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

Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const auto cannotRead = [&](const std::string& reason) {
        return fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), reason);
    };
    // A pipe that nobody writes to would be waited for.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return cannotRead(systemReason(errno));
    const File file{::fdopen(descriptor, "rb")};
    struct stat status {};
    if (!file || ::fstat(descriptor, &status) != 0) return cannotRead(systemReason(errno));
    if (S_ISDIR(status.st_mode)) return cannotRead(systemReason(EISDIR));
    if (!S_ISREG(status.st_mode)) return cannotRead("it is not a regular file");
    const auto tooLarge = [&] { return cannotRead(fmt::format("it has more than {} bytes", maxBytes)); };
    if (static_cast<std::size_t>(status.st_size) > maxBytes) return tooLarge();
    std::string bytes;
    std::array<char, 65536> part;
    while (const std::size_t partBytes = std::fread(part.data(), 1, part.size(), file.get())) {
        if (bytes.size() + partBytes > maxBytes) return tooLarge();  // it grows
        bytes.append(part.data(), partBytes);
    }
    if (std::ferror(file.get()) != 0) return cannotRead(systemReason(errno));
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
    if (errorNumber == 0) {
        syncFolder(path);
        return {};
    }
    std::filesystem::remove(temporary->path, ignored);
    return cannotWrite(path, errorNumber);
}

}  // namespace terrane::base
