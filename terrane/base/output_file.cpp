#include "terrane/base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <system_error>
#include <utility>

namespace terrane::base {

namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannotBeWritten(const fs::path& path, int errorNumber) {
    return fail(ErrorCode::Io, "{}: cannot be written: {}", path.string(), systemReason(errorNumber));
}

// Makes a file's new name survive a power failure. Errors are ignored, since not all file systems support it.
void syncFolder(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

// Resolves symbolic links, also to a file that does not exist yet. Still a link if the links form a cycle.
fs::path behindLinks(fs::path file) {
    constexpr int kMaxLinks = 40;  // the system's limit
    std::error_code ignored;
    for (int k = 0; k < kMaxLinks && fs::is_symlink(file, ignored); ++k) {
        file = file.parent_path() / fs::read_symlink(file, ignored);
    }
    return file;
}

// Fails if the path names anything but a regular file, unless nothing exists there.
Result<void> checkReplaceable(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_symlink(path, ignored)) return cannotBeWritten(path, ELOOP);
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) return cannotBeWritten(path, EISDIR);
    if (!fs::exists(status) || fs::is_regular_file(status)) return {};
    return fail(ErrorCode::Io, "{}: cannot be written: it is not a regular file", path.string());
}

// Calls `take` with temporary names until it accepts one, so that two writers of one path never share a
// temporary file. Returns zero or the error number; EEXIST if all names are in use.
template <class Take>
int takeTemporaryName(const fs::path& path, Take take) {
    constexpr int kMaxAttempts = 1000;  // far more than writers at once and leftovers of crashes together
    int error = EEXIST;
    for (int attempt = 0; attempt < kMaxAttempts && error == EEXIST; ++attempt) {
        fs::path temporary = path;
        temporary += fmt::format(".tmp{}", attempt);
        error = take(temporary) ? 0 : errno;
    }
    return error;
}

std::string linkOf(int descriptor) {
    return fmt::format("/proc/self/fd/{}", descriptor);
}

// Opens a file without a name in the path's folder; negative if that is not possible, or if the file could
// not be named later.
int openWithoutName(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 || ::access(linkOf(descriptor).c_str(), F_OK) == 0) return descriptor;
    ::close(descriptor);
    return -1;
}

// Gives the new file the mode of the file that it replaces, which may be readable by its owner only.
void keepMode(int descriptor, const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) (void)::fchmod(descriptor, status.st_mode & 0777);
}

tl::unexpected<Error> tooManyTemporary(const fs::path& path) {
    return fail(ErrorCode::Io, "{}: cannot be written: delete the old files {}.tmp* beside it", path.string(),
                path.filename().string());
}

}  // namespace

Result<OutputFile> OutputFile::create(const fs::path& given) {
    const fs::path path = behindLinks(given);
    TERRANE_TRY(checkReplaceable(path));
    const auto made = [&](int descriptor, fs::path temporary) {
        keepMode(descriptor, path);
        return OutputFile(descriptor, path, std::move(temporary));
    };
    int descriptor = openWithoutName(path);
    if (descriptor >= 0) return made(descriptor, {});
    fs::path taken;
    const int error = takeTemporaryName(path, [&](const fs::path& temporary) {
        descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) taken = temporary;
        return descriptor >= 0;
    });
    if (error == 0) return made(descriptor, std::move(taken));
    if (error == EEXIST) return tooManyTemporary(path);
    return cannotBeWritten(path, error);
}

OutputFile::~OutputFile() {
    close();
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, fs::path())) {}

// Returns zero or the error number: a full disk may be reported only by close().
int OutputFile::close() {
    if (descriptor_ < 0) return 0;
    return ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
}

// Returns zero or the error number.
int OutputFile::nameTemporarily() {
    if (!temporary_.empty()) return 0;
    const std::string link = linkOf(descriptor_);
    return takeTemporaryName(path_, [&](const fs::path& temporary) {
        const bool done =
            ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, temporary.c_str(), AT_SYMLINK_FOLLOW) == 0;
        if (done) temporary_ = temporary;
        return done;
    });
}

int OutputFile::rename() {
    return std::rename(temporary_.c_str(), path_.c_str()) == 0 ? 0 : errno;
}

Result<void> OutputFile::reserve(std::uint64_t sizeBytes) {
    assert(descriptor_ >= 0 && "room is reserved in an open file");
    const auto doNotFit = [&](int errorNumber) {
        return fail(ErrorCode::OutOfResources, "{}: {} bytes do not fit: {}", path_.string(), sizeBytes,
                    systemReason(errorNumber));
    };
    if (sizeBytes > static_cast<std::uint64_t>(INT64_MAX)) return doNotFit(EFBIG);
    const int error =
        ::fallocate(descriptor_, 0, 0, static_cast<off_t>(sizeBytes)) == 0 || sizeBytes == 0 ? 0 : errno;
    if (error == 0) return {};
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) return doNotFit(error);
    std::error_code unknown;
    const fs::space_info space = fs::space(path_.has_parent_path() ? path_.parent_path() : ".", unknown);
    if (!unknown && space.available < sizeBytes) return doNotFit(ENOSPC);
    return {};
}

Result<void> OutputFile::write(std::uint64_t offsetBytes, std::string_view bytes) {
    assert(descriptor_ >= 0 && "an open file is written");
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offsetBytes));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return cannotBeWritten(path_, count < 0 ? errno : EIO);
        bytes.remove_prefix(static_cast<std::size_t>(count));
        offsetBytes += static_cast<std::uint64_t>(count);
    }
    return {};
}

Result<void> OutputFile::finish() {
    assert(descriptor_ >= 0 && "a file is finished once");
    int error = ::fsync(descriptor_) == 0 ? 0 : errno;
    if (error == 0) error = nameTemporarily();
    if (error == EEXIST) return tooManyTemporary(path_);
    const int closeError = close();
    if (error == 0) error = closeError;
    if (error == 0) error = rename();
    if (error != 0) return cannotBeWritten(path_, error);
    temporary_.clear();
    syncFolder(path_);
    return {};
}

}  // namespace terrane::base
