#include "terrane/store/saves/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <string>

namespace terrane::store {
namespace {

// " (process N)" of the last process that took the lock, or empty.
std::string ownerOf(int descriptor) {
    std::array<char, 16> text{};
    const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
    const auto count = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }));
    return size > 0 && count > 0 ? " (process " + std::string(text.data(), count) + ")" : "";
}

// Errors are ignored: the file is only read for messages and for the check of logs.
void writeOwner(int descriptor, bool hasLog) {
    std::array<char, 32> text{};
    const int size = std::snprintf(text.data(), text.size(), hasLog ? "%d %s" : "%d", ::getpid(), kLogWord);
    if (::ftruncate(descriptor, 0) == 0)
        (void)!::pwrite(descriptor, text.data(), static_cast<std::size_t>(size), 0);
}

// Whether it is a regular file with a single name, so that writing changes no other file.
bool isOrdinary(int descriptor) {
    struct stat opened {};
    return ::fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode) && opened.st_nlink <= 1;
}

// False if the lock's last owner removed the file after it was opened here.
bool isStillThere(int descriptor, const std::filesystem::path& file) {
    struct stat opened {
    }, there{};
    return ::fstat(descriptor, &opened) == 0 && ::lstat(file.c_str(), &there) == 0 &&
           opened.st_ino == there.st_ino && opened.st_dev == there.st_dev;
}

// Returns -1 with errno if the file cannot be created or opened. Without write permission a shared lock opens
// it read-only.
int openLockFile(const std::filesystem::path& file, FileLock::Kind kind) {
    constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | kFlags, 0644);
    const bool isForbidden = descriptor < 0 && (errno == EACCES || errno == EROFS || errno == EPERM);
    if (!isForbidden || kind == FileLock::Kind::Exclusive) return descriptor;
    return ::open(file.c_str(), O_RDONLY | kFlags);
}

}  // namespace

base::Result<FileLock> FileLock::acquire(const std::filesystem::path& path, Kind kind) {
    std::filesystem::path file = path;
    file += "-lock";
    while (true) {
        const int descriptor = openLockFile(file, kind);
        if (descriptor < 0 && errno == ENOENT && kind == Kind::Shared) return FileLock(-1, kind, {});
        if (descriptor < 0)
            return base::fail(base::ErrorCode::Io, "{}: cannot be {}: {}", file.string(),
                              kind == Kind::Shared ? "opened" : "written",
                              errno == ELOOP ? "a symbolic link" : base::systemReason(errno));
        FileLock lock(descriptor, kind, file);
        if (!isOrdinary(descriptor)) {
            lock.file_.clear();
            return base::fail(base::ErrorCode::Io, "{}: a link, or not a regular file; it is not opened",
                              file.string());
        }
        if (::flock(descriptor, (kind == Kind::Exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
            const int error = errno;
            lock.file_.clear();  // the other program removes it
            if (error != EWOULDBLOCK)
                return base::fail(base::ErrorCode::Io, "{}: cannot be locked: {}", path.string(),
                                  base::systemReason(error));
            return base::fail(base::ErrorCode::Busy, "{}: open in another program{}", path.string(),
                              ownerOf(descriptor));
        }
        if (!isStillThere(descriptor, file)) {
            lock.file_.clear();
            continue;
        }
        if (kind == Kind::Exclusive) writeOwner(descriptor, false);
        return lock;
    }
}

FileLock::~FileLock() {
    release();
}

FileLock::FileLock(FileLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      kind_(other.kind_),
      hasLog_(other.hasLog_),
      file_(std::move(other.file_)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    release();
    descriptor_ = std::exchange(other.descriptor_, -1);
    kind_ = other.kind_;
    hasLog_ = other.hasLog_;
    file_ = std::move(other.file_);
    return *this;
}

void FileLock::setHasLog(bool hasLog) {
    if (descriptor_ < 0 || std::exchange(hasLog_, hasLog) == hasLog) return;
    writeOwner(descriptor_, hasLog);
    ::fdatasync(descriptor_);
}

void FileLock::release() {
    if (descriptor_ < 0) return;
    // Removed only by the last owner, since others may share it. A killed program's notes stay until the save
    // is opened for writing.
    struct stat status {};
    const bool isOwn =
        kind_ == Kind::Exclusive || (::fstat(descriptor_, &status) == 0 && status.st_size == 0);
    if (isOwn && !file_.empty() && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) ::unlink(file_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
}

}  // namespace terrane::store
