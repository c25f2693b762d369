// The keys of servers that a player was on: a line each, "HOST:PORT KEY". The first time a server is
// believed; from then on it has to have the same key. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "terrane/base/result.h"

namespace terrane::net {

// Whether the server has the key that it had before, or none was known: then it is written into the file.
[[nodiscard]] base::Result<bool> isKnownOrNew(const std::filesystem::path& file, const std::string& server,
                                              const std::string& key);

}  // namespace terrane::net
