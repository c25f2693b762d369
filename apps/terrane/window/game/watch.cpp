#include "apps/terrane/window/game/watch.h"

#include <string>
#include <system_error>

#include "terrane/base/log.h"

namespace terrane::app {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLookEvery{500};

}  // namespace

ContentWatch::ContentWatch(const std::vector<pack::Pack>& packs, fs::file_time_type readAt) {
    for (const pack::Pack& pack : packs)
        if (!pack.where.empty()) packs_.emplace_back(pack.where);
    reported_ = seen_ = look();
    std::erase_if(reported_, [&](const auto& file) { return file.second >= readAt; });
}

ContentWatch::Files ContentWatch::look() const {
    Files files;
    std::error_code ignored;
    const auto add = [&](const fs::path& path) {
        if (fs::is_regular_file(path, ignored)) files[path] = fs::last_write_time(path, ignored);
    };
    for (const fs::path& pack : packs_) {
        add(pack);  // a zip file
        for (const std::string inside : {"", "textures/", "generators/", "scripts/", "languages/"}) {
            std::error_code error;
            for (fs::directory_iterator it(pack / inside, error), end; !error && it != end;
                 it.increment(error))
                if (pack::isPackPath(inside + it->path().filename().string())) add(it->path());
        }
    }
    return files;
}

bool ContentWatch::hasChanged(std::chrono::steady_clock::time_point now) {
    if (now < nextLook_) return false;
    nextLook_ = now + kLookEvery;
    Files files = look();
    const bool isSettled = files == seen_;
    seen_ = std::move(files);
    if (!isSettled || seen_ == reported_) return false;
    reported_ = seen_;
    return true;
}

std::optional<std::string> ShaderWatch::reload(render::Renderer& renderer, view::BlockPreview& preview,
                                               double seconds) {
    const WriteTime written = written_.at(seconds, [&] { return shaders_.newestWrite(); });
    if (written == read_) return std::nullopt;
    read_ = written;
    auto done = renderer.reloadShaders();
    if (done) done = preview.reloadShaders();
    if (done) return "shaders reloaded";
    base::logWarning("{}", done.error().message);
    return done.error().message;
}

}  // namespace terrane::app
