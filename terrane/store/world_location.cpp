#include "terrane/store/world_location.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "terrane/store/save_path.h"

namespace terrane::store {
namespace {

constexpr std::string_view kSchemeEnd = "://";

// Whether the text looks like a database URL, even a misspelled one: it may hold a password and must not
// become a file name.
bool isMeantAsDatabase(std::string_view text) {
    constexpr std::string_view kStart = "postgres";
    const auto isSame = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    return std::ranges::equal(text.substr(0, kStart.size()), kStart, isSame) &&
           text.find_first_of(":@") != std::string_view::npos;
}

}  // namespace

WorldLocation worldLocation(std::string text) {
    using Kind = WorldLocation::Kind;
    const bool isUrl = text.find(kSchemeEnd) != std::string::npos || isMeantAsDatabase(text);
    const bool isFile = text.find('/') != std::string::npos || text.ends_with(".sqlite");
    return {isUrl ? Kind::Url : isFile ? Kind::File : Kind::Name, std::move(text)};
}

base::Result<std::filesystem::path> fileOf(const WorldLocation& location) {
    switch (location.kind) {
        case WorldLocation::Kind::Name:
            return savePath(location.text, savePlaces());
        case WorldLocation::Kind::File:
            return std::filesystem::path(location.text);
        case WorldLocation::Kind::Url:
            break;
    }
    // The rest of a URL may hold a password.
    const std::string scheme = location.text.substr(0, location.text.find_first_of(":/@"));
    return base::fail(
        base::ErrorCode::Unsupported,
        "{}…: no URL of a world; a database is postgresql://host/database, where the build has them", scheme);
}

std::uintmax_t bytesOnDisk(const WorldLocation& location) {
    const auto path = fileOf(location);
    std::uintmax_t bytes = 0;
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        const std::uintmax_t size = path ? std::filesystem::file_size(path->string() + ending, error) : 0;
        if (!error) bytes += size;
    }
    return bytes;
}

}  // namespace terrane::store
