// Detects changes to files of content packs, for `play --watch`. Used on one thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <vector>

#include "terrane/pack/pack.h"

namespace terrane::app {

class ContentWatch {
  public:
    // Files that were saved after `readAt`, when the packs began to be read, count as changed.
    ContentWatch(const std::vector<pack::Pack>& packs, std::filesystem::file_time_type readAt);

    // Whether a file was added, removed or changed since the last call. Looks at most twice a second, and
    // reports a change once the files were stable for that long: editors write a file in several steps.
    bool hasChanged(std::chrono::steady_clock::time_point now);

  private:
    using Files = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Files look() const;

    std::vector<std::filesystem::path> packs_;
    Files reported_, seen_;
    std::chrono::steady_clock::time_point nextLook_{};
};

}  // namespace terrane::app
