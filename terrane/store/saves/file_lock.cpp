#include "terrane/store/saves/file_lock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "terrane/base/platform.h"

namespace terrane::store {
namespace {

namespace platform = base::platform;

// " (process N)" of the last process that took the lock, or empty.
std::string ownerOf(int descriptor) {
    std::array<char, 16> text{};
    const std::ptrdiff_t size = platform::readAt(descriptor, text, 0);
    const auto count = static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }));
    return size > 0 && count > 0 ? " (process " + std::string(text.data(), count) + ")" : "";
}

// Errors are ignored: the file is only read for messages and for the check of logs.
void writeOwner(int descriptor, bool hasLog) {
    const std::string text =
        fmt::format("{}{}{}", platform::processNumber(), hasLog ? " " : "", hasLog ? kLogWord : "");
    if (platform::truncate(descriptor) == 0) (void)platform::writeAt(descriptor, text, 0);
}

// Whether it is a regular file with a single name, so that writing changes no other file.
bool isOrdinary(int descriptor) {
    const auto opened = platform::statusOf(descriptor);
    return opened && opened->isRegular && opened->nameCount <= 1;
}

// False if the lock's last owner removed the file after it was opened here.
bool isStillThere(int descriptor, const std::filesystem::path& file) {
    const auto opened = platform::statusOf(descriptor),
               there = platform::statusOf(file, platform::Links::Keep);
    return opened && there && opened->identity == there->identity;
}

}  // namespace

base::Result<FileLock> FileLock::acquire(const std::filesystem::path& path, Kind kind) {
    std::filesystem::path file = path;
    file += "-lock";
    while (true) {
        const int descriptor = platform::openLockFile(file, kind == Kind::Shared);
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
        if (const int error = platform::tryLock(descriptor, kind == Kind::Shared); error != 0) {
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
    (void)platform::flush(descriptor_);
}

void FileLock::release() {
    if (descriptor_ < 0) return;
    // Removed only by the last owner, since others may share it. A killed program's notes stay until the save
    // is opened for writing.
    const auto status = platform::statusOf(descriptor_);
    const bool isOwn = kind_ == Kind::Exclusive || (status && status->sizeBytes == 0);
    std::error_code ignored;
    if (isOwn && !file_.empty() && platform::tryLock(descriptor_, false) == 0)
        std::filesystem::remove(file_, ignored);
    platform::closeFile(std::exchange(descriptor_, -1));
}

}  // namespace terrane::store
