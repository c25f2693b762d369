#include "terrane/net/known_servers.h"

#include <sstream>
#include <system_error>

#include "terrane/base/files.h"

namespace terrane::net {

base::Result<bool> isKnownOrNew(const std::filesystem::path& file, const std::string& server,
                                const std::string& key) {
    std::error_code ignored;
    std::string text;
    if (std::filesystem::exists(file, ignored)) {
        auto read = base::readFile(file);
        if (!read) return tl::unexpected(read.error());
        text = std::move(*read);
    }
    std::istringstream lines(text);
    std::string name, known;
    while (lines >> name >> known)
        if (name == server) return known == key;
    std::filesystem::create_directories(file.parent_path(), ignored);
    if (!text.empty() && text.back() != '\n') text += '\n';
    auto written = base::writeFile(file, text + server + ' ' + key + '\n');
    if (!written) return tl::unexpected(written.error());
    return true;
}

}  // namespace terrane::net
