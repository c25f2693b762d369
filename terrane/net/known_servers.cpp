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
        auto read = TERRANE_TRY(base::readFile(file));
        text = std::move(read);
    }
    std::istringstream lines(text);
    std::string name, known;
    while (lines >> name >> known)
        if (name == server) return known == key;
    std::filesystem::create_directories(file.parent_path(), ignored);
    if (!text.empty() && text.back() != '\n') text += '\n';
    TERRANE_TRY(base::writeFile(file, text + server + ' ' + key + '\n'));
    return true;
}

}  // namespace terrane::net
