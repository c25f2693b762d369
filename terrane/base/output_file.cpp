#include "terrane/base/output_file.h"

#include <cassert>
#include <cerrno>
#include <system_error>
#include <utility>

#include "terrane/base/platform.h"

namespace terrane::base {

namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannotBeWritten(const fs::path& path, int errorNumber) {
    return fail(ErrorCode::Io, "{}: cannot be written: {}", path.string(), systemReason(errorNumber));
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
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

// Calls `take` with temporary names until it returns another error than EEXIST, so that two writers of one
// path never share a temporary file. Returns its last result.
template <class Take>
int takeTemporaryName(const fs::path& path, Take take) {
    constexpr int kMaxAttempts = 1000;  // far more than writers at once and leftovers of crashes together
    int error = EEXIST;
    for (int attempt = 0; attempt < kMaxAttempts && error == EEXIST; ++attempt) {
        fs::path temporary = path;
        temporary += fmt::format(".tmp{}", attempt);
        error = take(temporary);
    }
    return error;
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
        platform::takeMode(descriptor, path);
        return OutputFile(descriptor, path, std::move(temporary));
    };
    int descriptor = platform::createUnnamed(folderOf(path));
    if (descriptor >= 0) return made(descriptor, {});
    fs::path taken;
    const int error = takeTemporaryName(path, [&](const fs::path& temporary) {
        descriptor = platform::createFile(temporary, platform::Readers::Everybody);
        if (descriptor < 0) return errno;
        taken = temporary;
        return 0;
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
    return platform::closeFile(std::exchange(descriptor_, -1));
}

// Returns zero or the error number.
int OutputFile::nameTemporarily() {
    if (!temporary_.empty()) return 0;
    return takeTemporaryName(path_, [&](const fs::path& temporary) {
        const int error = platform::giveName(descriptor_, temporary);
        if (error == 0) temporary_ = temporary;
        return error;
    });
}

Result<void> OutputFile::reserve(std::uint64_t sizeBytes) {
    assert(descriptor_ >= 0 && "room is reserved in an open file");
    const auto doNotFit = [&](int errorNumber) {
        return fail(ErrorCode::OutOfResources, "{}: {} bytes do not fit: {}", path_.string(), sizeBytes,
                    systemReason(errorNumber));
    };
    const int error = platform::reserve(descriptor_, sizeBytes);
    if (error == 0) return {};
    if (platform::isNoRoom(error)) return doNotFit(error);
    std::error_code unknown;
    const fs::space_info space = fs::space(folderOf(path_), unknown);
    if (!unknown && space.available < sizeBytes) return doNotFit(ENOSPC);
    return {};
}

Result<void> OutputFile::write(std::uint64_t offsetBytes, std::string_view bytes) {
    assert(descriptor_ >= 0 && "an open file is written");
    const int error = platform::writeAt(descriptor_, bytes, offsetBytes);
    return error == 0 ? Result<void>() : cannotBeWritten(path_, error);
}

Result<void> OutputFile::finish() {
    assert(descriptor_ >= 0 && "a file is finished once");
    int error = platform::flush(descriptor_);
    if (error == 0) error = nameTemporarily();
    if (error == EEXIST) return tooManyTemporary(path_);
    const int closeError = close();
    if (error == 0) error = closeError;
    if (error == 0) error = platform::replaceFile(temporary_, path_);
    if (error != 0) return cannotBeWritten(path_, error);
    temporary_.clear();
    (void)platform::flushFolder(folderOf(path_));  // so that the name survives a power failure
    return {};
}

}  // namespace terrane::base
