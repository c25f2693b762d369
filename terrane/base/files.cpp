#include "terrane/base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "terrane/base/output_file.h"

namespace terrane::base {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Returns 0 or errno.
int writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return ::fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const auto cannotRead = [&](const std::string& reason) {
        return fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), reason);
    };
    // O_NONBLOCK: opening a pipe without a writer would block.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return cannotRead(systemReason(errno));
    const File file{::fdopen(descriptor, "rb")};
    if (!file) {
        const int error = errno;
        ::close(descriptor);
        return cannotRead(systemReason(error));
    }
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return cannotRead(systemReason(errno));
    if (S_ISDIR(status.st_mode)) return cannotRead(systemReason(EISDIR));
    if (!S_ISREG(status.st_mode)) return cannotRead("it is not a regular file");
    const auto tooLarge = [&] { return cannotRead(fmt::format("it has more than {} bytes", maxBytes)); };
    if (static_cast<std::size_t>(status.st_size) > maxBytes) return tooLarge();
    std::string bytes;
    std::array<char, 65536> part;
    while (const std::size_t partBytes = std::fread(part.data(), 1, part.size(), file.get())) {
        if (bytes.size() + partBytes > maxBytes) return tooLarge();  // the file grows
        bytes.append(part.data(), partBytes);
    }
    if (std::ferror(file.get()) != 0) return cannotRead(systemReason(errno));
    return bytes;
}

Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes) {
    OutputFile file = TERRANE_TRY(OutputFile::create(path));
    TERRANE_TRY(file.write(0, bytes));
    return file.finish();
}

Result<void> writeFiles(std::span<const FileToWrite> files) {
    std::vector<OutputFile> outputs;
    for (const FileToWrite& file : files) {
        OutputFile output = TERRANE_TRY(OutputFile::create(file.path));
        TERRANE_TRY(output.write(0, file.bytes));
        outputs.push_back(std::move(output));
    }
    for (std::size_t k = 0; k < files.size(); ++k) {
        auto finished = outputs[k].finish();
        if (finished) continue;
        std::error_code ignored;
        for (std::size_t done = 0; done < k; ++done) std::filesystem::remove(files[done].path, ignored);
        return finished;
    }
    return {};
}

Result<void> writePrivateFile(const std::filesystem::path& path, std::string_view bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    int error = descriptor < 0 ? errno : writeAll(descriptor, bytes);
    if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) return {};
    if (descriptor >= 0) ::unlink(path.c_str());
    return fail(ErrorCode::Io, "{}: cannot be written: {}", path.string(), systemReason(error));
}

Result<TemporaryFolder> TemporaryFolder::make(const std::filesystem::path& parent, std::string_view prefix) {
    std::string path = parent / (std::string(prefix) + "XXXXXX");
    if (::mkdtemp(path.data())) return TemporaryFolder(path);
    return fail("{}: no folder can be made in it: {}", parent.string(), systemReason(errno));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace terrane::base
