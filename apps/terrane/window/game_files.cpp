// What the window's loop writes and reads beside the world: bookmarks, screenshots, the world's picture.
#include <fmt/format.h>

#include <filesystem>

#include "apps/terrane/window/game.h"
#include "apps/terrane/window/thumbnail.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

// The first name of its kind that is free in the folder.
std::filesystem::path freeScreenshot(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = folder / fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

void Game::saveBookmark() {
    const auto done = game::appendBookmark(bookmarks_.file, player_.pose());
    say(done ? fmt::format(fmt::runtime(tr_("bookmark saved in {}")), bookmarks_.file.string())
             : done.error().message);
}

void Game::nextBookmark() {
    const auto bookmarks = game::readBookmarks(bookmarks_);
    if (!bookmarks) return say(bookmarks.error().message);
    if (bookmarks->empty()) return say(tr_("no bookmark is saved yet (F5)"));
    player_.placeAt((*bookmarks)[nextBookmark_++ % bookmarks->size()], settings_.movement);
}

void Game::takeScreenshot() {
    if (!hasWorldImage()) return;
    std::error_code ignored;  // writing tells
    std::filesystem::create_directories(screenshots_, ignored);
    const std::filesystem::path file = freeScreenshot(screenshots_);
    const base::Image image = parts_.renderer.readImage();
    const auto done = base::writePng(file, image);
    if (done) hud_.screenshot.show(image);
    say(done ? fmt::format(fmt::runtime(tr_("screenshot {}")), file.string()) : done.error().message);
}

void Game::writeThumbnail() {
    untilThumbnail_ = kThumbnailPause;
    if (thumbnail_.empty() || !hasWorldImage()) return;
    const auto done = base::writePng(thumbnail_, thumbnailFrom(parts_.renderer.readImage()));
    if (!done) base::logInfo("{}", done.error().message);  // a list without a picture is no loss
}

}  // namespace terrane::app
