// The keys of servers that a player visited, one "HOST:PORT KEY" per line. A server is trusted on first use;
// later it must have the same key. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "terrane/base/result.h"

namespace terrane::net {

// Whether the server has its known key. An unknown server's key is added to the file.
[[nodiscard]] base::Result<bool> isKnownOrNew(const std::filesystem::path& file, const std::string& server,
                                              const std::string& key);

}  // namespace terrane::net
