// The template that new packs start from. Any thread.
#pragma once

#include <filesystem>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::pack {

// The name of the skeleton's generator, within the pack.
constexpr std::string_view kSkeletonGenerator = "hills";

// Writes a pack that works as it is: a glowing block with its texture, a generator that uses it, names of
// blocks, all with comments. The pack has the folder's name. An error if the folder exists.
[[nodiscard]] base::Result<void> writeSkeleton(const std::filesystem::path& folder);

}  // namespace terrane::pack
