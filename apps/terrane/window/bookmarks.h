// Bookmarks: camera bookmarks that the player keeps in a text file, one a line: x y z yaw pitch.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/render/camera.h"

namespace terrane::app {

constexpr const char* kBookmarksFile = "bookmarks.txt";        // in the working directory
constexpr const char* kFormerBookmarksFile = "positions.txt";  // its name before 0.2

std::string textOf(const render::Camera& camera);                   // "x y z yaw pitch"
std::optional<render::Camera> cameraFrom(const std::string& text);  // none for anything else

// Those of the file of the former name in the same folder, then those of the file; none where neither is
// there. An error names the first line that is wrong.
base::Result<std::vector<render::Camera>> readBookmarks(const std::filesystem::path& file);
base::Result<void> appendBookmark(const std::filesystem::path& file, const render::Camera& camera);

}  // namespace terrane::app
