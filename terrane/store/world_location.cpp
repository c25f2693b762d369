#include "terrane/store/world_location.h"

#include <string_view>
#include <system_error>
#include <utility>

#include "terrane/store/save_path.h"

namespace terrane::store {
namespace {

constexpr std::string_view kSchemeEnd = "://";

}  // namespace

WorldLocation worldLocation(std::string text) {
    using Kind = WorldLocation::Kind;
    const bool isUrl = text.find(kSchemeEnd) != std::string::npos;
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
    const std::string scheme = location.text.substr(0, location.text.find(kSchemeEnd));
    return base::fail(base::ErrorCode::Unsupported,
                      "{}://…: a world in a database is not supported by this build", scheme);
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
