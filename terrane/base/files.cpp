#include "terrane/base/files.h"

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "terrane/base/output_file.h"
#include "terrane/base/platform.h"

namespace terrane::base {

namespace {

// Closes a file that was read.
struct FileCloser {
    int descriptor;
    ~FileCloser() { platform::closeFile(descriptor); }
};

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const auto cannotRead = [&](const std::string& reason) {
        return fail(ErrorCode::Io, "{}: cannot be read: {}", path.string(), reason);
    };
    const int descriptor = platform::openToRead(path);
    if (descriptor < 0) return cannotRead(systemReason(errno));
    const FileCloser closer{descriptor};
    const auto status = platform::statusOf(descriptor);
    if (!status) return cannotRead(systemReason(errno));
    if (status->isFolder) return cannotRead(systemReason(EISDIR));
    if (!status->isRegular) return cannotRead("it is not a regular file");
    const auto tooLarge = [&] { return cannotRead(fmt::format("it has more than {} bytes", maxBytes)); };
    if (status->sizeBytes > maxBytes) return tooLarge();
    std::string bytes;
    std::array<char, 65536> part;
    for (;;) {
        const std::ptrdiff_t count = platform::readSome(descriptor, part);
        if (count < 0) return cannotRead(systemReason(errno));
        if (count == 0) return bytes;
        if (bytes.size() + static_cast<std::size_t>(count) > maxBytes) return tooLarge();  // the file grows
        bytes.append(part.data(), static_cast<std::size_t>(count));
    }
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
    const int descriptor = platform::createFile(path, platform::Readers::Owner);
    int error = descriptor < 0 ? errno : platform::writeAt(descriptor, bytes, 0);
    if (error == 0) error = platform::flush(descriptor);
    const int closeError = descriptor < 0 ? 0 : platform::closeFile(descriptor);
    if (error == 0) error = closeError;
    if (error == 0) return {};
    std::error_code ignored;
    if (descriptor >= 0) std::filesystem::remove(path, ignored);
    return fail(ErrorCode::Io, "{}: cannot be written: {}", path.string(), systemReason(error));
}

Result<TemporaryFolder> TemporaryFolder::make(const std::filesystem::path& parent, std::string_view prefix) {
    std::filesystem::path made;
    const int error = platform::makeFolder(parent / prefix, made);
    if (error == 0) return TemporaryFolder(made);
    return fail("{}: no folder can be made in it: {}", parent.string(), systemReason(error));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace terrane::base
