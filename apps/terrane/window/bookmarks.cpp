#include "apps/terrane/window/bookmarks.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace terrane::app {

std::string textOf(const render::Camera& camera) {
    const glm::dvec3& p = camera.position;
    return fmt::format("{} {} {} {} {}", p.x, p.y, p.z, camera.yaw, camera.pitch);
}

std::optional<render::Camera> cameraFrom(const std::string& text) {
    std::istringstream in(text);
    render::Camera c;
    in >> c.position.x >> c.position.y >> c.position.z >> c.yaw >> c.pitch;
    const bool isGood = !in.fail() && (in >> std::ws).eof() && std::isfinite(c.yaw) &&
                        std::abs(c.pitch) <= 90 && std::isfinite(c.position.z) &&
                        std::abs(c.position.x) < 0x1p31 && std::abs(c.position.y) < 0x1p31;
    return isGood ? std::optional(c) : std::nullopt;
}

namespace {

base::Result<void> readInto(std::vector<render::Camera>& bookmarks, const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const auto camera = cameraFrom(line);
        if (!camera)
            return base::fail("{}:{}: expected x y z yaw pitch, got \"{}\"", file.string(), number, line);
        bookmarks.push_back(*camera);
    }
    return {};
}

}  // namespace

base::Result<std::vector<render::Camera>> readBookmarks(const std::filesystem::path& file) {
    std::vector<render::Camera> bookmarks;
    for (const auto& each : {file.parent_path() / kFormerBookmarksFile, file}) {
        if (auto read = readInto(bookmarks, each); !read) return tl::unexpected(read.error());
    }
    return bookmarks;
}

base::Result<void> appendBookmark(const std::filesystem::path& file, const render::Camera& camera) {
    std::ofstream out(file, std::ios::app);
    out << textOf(camera) << '\n';
    out.flush();
    if (!out) return base::fail("{}: cannot be written", file.string());
    return {};
}

}  // namespace terrane::app
