// Camera positions that a person keeps in a text file, one a line: x y z yaw pitch.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/render/camera.h"

namespace terrane::app {

constexpr const char* kPositionsFile = "positions.txt";  // in the working directory

std::string textOf(const render::Camera& camera);                   // "x y z yaw pitch"
std::optional<render::Camera> cameraFrom(const std::string& text);  // none for anything else

// Those of the file, none where it is not there. An error names the first line that is wrong.
base::Result<std::vector<render::Camera>> readPositions(const std::filesystem::path& file);
base::Result<void> appendPosition(const std::filesystem::path& file, const render::Camera& camera);

}  // namespace terrane::app
