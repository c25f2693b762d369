#include "terrane/base/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "terrane/base/output_file.h"

namespace terrane::base {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

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
    Result<OutputFile> file = OutputFile::create(path);
    if (!file) return tl::unexpected(file.error());
    if (auto written = file->write(0, bytes); !written) return written;
    return file->finish();
}

}  // namespace terrane::base
