#include "apps/terrane/window/title/world_shelf.h"

#include <epoxy/gl.h>
#include <fmt/chrono.h>

#include <algorithm>
#include <chrono>
#include <span>

#include "apps/terrane/window/game/pictures.h"
#include "terrane/base/image.h"

namespace terrane::app {
namespace {

// A limit, since the file may be from elsewhere.
constexpr std::int64_t kMaxPicturePixels = 16 * kThumbnailWidth * kThumbnailHeight;

gpu::Texture2D textureOf(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return {};
    const auto image = base::readPng(file, kMaxPicturePixels);
    if (!image) return {};  // shown without an image
    const base::Image small = thumbnailFrom(*image);
    gpu::Texture2D texture({small.width, small.height}, GL_RGBA8, 1, "picture of a world");
    texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(small.rgba)));
    return texture;
}

std::string sizeText(std::uintmax_t bytes) {
    constexpr double kMega = 1e6;
    const double size = static_cast<double>(bytes);
    return size < kMega ? fmt::format("{:.0f} kB", size / 1e3) : fmt::format("{:.1f} MB", size / kMega);
}

std::string timeText(std::filesystem::file_time_type time) {
    using namespace std::chrono;
    // The epoch of the file clock is unspecified: convert by the distance from now.
    const auto age = std::filesystem::file_time_type::clock::now() - time;
    const auto when =
        system_clock::to_time_t(system_clock::now() - duration_cast<system_clock::duration>(age));
    const std::time_t now = system_clock::to_time_t(system_clock::now());
    const std::tm then = fmt::localtime(when), today = fmt::localtime(now);
    if (then.tm_year == today.tm_year && then.tm_yday == today.tm_yday)
        return fmt::format("today {:%H:%M}", then);
    return fmt::format("{:%Y-%m-%d}", then);
}

}  // namespace

WorldShelf::WorldShelf(std::filesystem::path folder, const world::BlockRegistry& blocks)
    : folder_(std::move(folder)), blocks_(&blocks) {
    reload();
}

WorldShelf::~WorldShelf() {
    cancelCopy();
    if (copying_.valid()) copying_.wait();
}

void WorldShelf::reload() {
    const std::string name = chosen() ? chosen()->name : "";
    worlds_ = store::listWorlds(folder_, *blocks_);
    pictures_.clear();
    const auto found = std::ranges::find(worlds_, name, &store::WorldEntry::name);
    chosen_ = found == worlds_.end() ? 0 : static_cast<std::size_t>(found - worlds_.begin());
}

const store::WorldEntry* WorldShelf::chosen() const {
    return chosen_ < worlds_.size() ? &worlds_[chosen_] : nullptr;
}

const store::WorldEntry* WorldShelf::last() const {
    for (const store::WorldEntry& world : worlds_)
        if (world.problem.empty() && world.inUse.empty()) return &world;
    return nullptr;
}

unsigned WorldShelf::picture(const store::WorldEntry& world) {
    auto found = pictures_.find(world.name);
    if (found == pictures_.end())
        found = pictures_.emplace(world.name, textureOf(store::thumbnailOf(world.path))).first;
    return found->second.id();
}

base::Result<void> WorldShelf::rename(const std::string& newName) {
    if (!chosen()) return {};
    auto done = store::renameWorld(folder_, chosen()->name, newName);
    if (done) worlds_[chosen_].name = newName;
    reload();
    return done;
}

base::Result<void> WorldShelf::remove() {
    if (!chosen()) return {};
    auto done = store::deleteWorld(folder_, chosen()->name);
    reload();
    return done;
}

void WorldShelf::startCopy(const std::string& newName) {
    if (!chosen() || isCopying()) return;
    share_ = 0;
    isCancelled_ = false;
    copyName_ = newName;
    const auto progress = [this](double share) {
        share_ = static_cast<float>(share);
        return !isCancelled_;
    };
    copying_ =
        std::async(std::launch::async, [this, progress, copy = store::SaveCopy{chosen()->name, newName}] {
            return store::copySave(folder_, copy, *blocks_, progress);
        });
}

std::optional<base::Result<void>> WorldShelf::takeCopy() {
    if (!isCopying() || copying_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    auto done = copying_.get();
    reload();
    const auto found = std::ranges::find(worlds_, copyName_, &store::WorldEntry::name);
    if (done && found != worlds_.end()) chosen_ = static_cast<std::size_t>(found - worlds_.begin());
    return done;
}

std::string describe(const store::WorldEntry& world) {
    if (!world.problem.empty()) return world.problem;
    const std::string last = world.inUse.empty() ? timeText(world.lastPlayed) : world.inUse;
    return fmt::format("{}, seed {}, {}, {}", world.identity.generator, world.identity.seed,
                       sizeText(world.sizeBytes), last);
}

}  // namespace terrane::app
