#include "terrane/store/companion_files.h"

#include <array>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <system_error>

#include "terrane/store/file_lock.h"

namespace terrane::store {
namespace {

using base::ErrorCode;
namespace fs = std::filesystem;

bool hasContent(const fs::path& path) {
    std::error_code ignored;  // an inaccessible file counts as missing
    const auto size = fs::file_size(path, ignored);
    return !ignored && size > 0;
}

base::Result<void> checkOrdinary(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(path, error);
    if (!fs::exists(status)) return {};
    if (fs::is_regular_file(status) && fs::hard_link_count(path, error) == 1) return {};
    return base::fail(ErrorCode::Incompatible, "{}: a link, or not a regular file; it is not opened",
                      path.string());
}

// A journal of several files ends with the name of a file that lists all (SQLite's file format, section 3:
// "The Super-Journal File"), a checksum, and these bytes. A save is a single file.
bool namesAnother(const fs::path& journal) {
    constexpr std::array<unsigned char, 8> kMagic = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    std::ifstream file(journal, std::ios::binary);
    std::array<char, kMagic.size()> end{};
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    return file.read(end.data(), end.size()) && std::memcmp(end.data(), kMagic.data(), end.size()) == 0;
}

}  // namespace

bool isPresent(const fs::path& path) {
    std::error_code ignored;  // an inaccessible file counts as missing
    return fs::exists(fs::symlink_status(path, ignored));
}

fs::path beside(const fs::path& save, const char* ending) {
    fs::path path = save;
    path += ending;
    return path;
}

base::Result<fs::path> ownPath(const fs::path& path) {
    std::error_code error;
    const fs::path own = fs::weakly_canonical(path, error);
    if (error) return base::fail(ErrorCode::Io, "{}: cannot be found: {}", path.string(), error.message());
    const auto names = fs::hard_link_count(own, error);
    if (!error && fs::is_regular_file(own, error) && names > 1)
        return base::fail(ErrorCode::Incompatible,
                          "{}: has {} names (hard links), and each would have a lock and a log of its own",
                          path.string(), names);
    return own;
}

bool hasLog(const fs::path& path) {
    return hasContent(beside(path, "-wal"));
}

bool hasJournal(const fs::path& path) {
    // SQLite ignores a journal that begins with 0 and leaves it there.
    return std::ifstream(beside(path, "-journal"), std::ios::binary).get() > 0;
}

std::string lostLog(const fs::path& path) {
    std::error_code ignored;
    if (fs::exists(beside(path, "-wal"), ignored)) return {};
    std::ifstream lock(beside(path, "-lock"));
    std::string number, word;
    lock >> std::setw(16) >> number >> std::setw(16) >> word;
    if (!lock || word != kLogWord) return {};
    return fmt::format(
        "{}-wal: missing, although a program that wrote to it was killed: the last saved changes "
        "are lost",
        path.string());
}

base::Result<void> checkCompanions(const fs::path& path) {
    for (const char* ending : {"-wal", "-shm", "-journal", "-lock"})
        TERRANE_TRY(checkOrdinary(beside(path, ending)));
    const fs::path journal = beside(path, "-journal");
    if (!namesAnother(journal)) return {};
    return base::fail(ErrorCode::Damaged, "{}: names another file, which would be deleted", journal.string());
}

}  // namespace terrane::store
