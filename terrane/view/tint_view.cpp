#include "terrane/view/tint_view.h"

#include <algorithm>
#include <exception>
#include <system_error>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::view {
namespace {

// Asked for at once: the thread follows a camera that moves on.
constexpr std::size_t kMaxRequested = 64;

bool hasTintedBlock(const world::BlockRegistry& blocks) {
    return std::ranges::any_of(blocks.materials(), [](const world::Material& m) { return m.tinted; });
}

world::TintTile neutralTile() {
    world::TintTile tile;
    tile.fill(world::kNeutralTint);
    return tile;
}

// Beyond the world's edge there is none.
world::TintTile tileOf(const gen::LevelGenerators& generators, world::ChunkPos pos) {
    if (!world::isInWorld(pos)) return neutralTile();
    try {
        return generators.tint(pos).value_or(neutralTile());
    } catch (const std::exception& error) {
        base::logWarning("the tint around {},{} is not known: {}", pos.x, pos.y, error.what());
        return neutralTile();
    }
}

}  // namespace

TintView::TintView(const game::Session& session, render::Renderer& renderer)
    : generators_(session.generators()), renderer_(renderer) {
    const bool hasTint = hasTintedBlock(session.blocks()) && generators_.hasTint();
    if (const auto used = renderer.useTint(hasTint); !used) {
        base::logError("blocks have no tint: {}", used.error().message);
        return;
    }
    if (!hasTint) return;
    try {
        thread_ = std::jthread([this] { run(); });
    } catch (const std::system_error& error) {  // colors are neutral then
        base::logWarning("no thread can be started for the tint of blocks: {}", error.what());
    }
}

TintView::~TintView() {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
    hasWork_.notify_all();
}

void TintView::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        hasWork_.wait(lock, [this] { return isEnding_ || !waiting_.empty(); });
        if (isEnding_) return;
        const world::ChunkPos pos = waiting_.front();
        waiting_.pop_front();
        lock.unlock();
        const world::TintTile tile = [&] {
            TERRANE_ZONE("tint");
            return tileOf(generators_, pos);
        }();
        lock.lock();
        finished_.emplace_back(pos, tile);
        hasFinished_.notify_all();
    }
}

std::vector<TintView::Tile> TintView::takeFinished(std::size_t limit) {
    const std::lock_guard lock(mutex_);
    const auto end = finished_.begin() + static_cast<std::ptrdiff_t>(std::min(limit, finished_.size()));
    std::vector<Tile> tiles(finished_.begin(), end);
    finished_.erase(finished_.begin(), end);
    return tiles;
}

void TintView::update(world::ChunkPos camera, double reach, std::size_t limit) {
    if (!thread_.joinable()) return;
    TERRANE_ZONE("upload tint");
    for (const auto& [pos, colors] : takeFinished(limit)) {
        renderer_.setTint(pos, colors);
        requested_.erase(pos);
    }
    std::vector<world::ChunkPos> more;
    for (const world::ChunkPos tile : renderer_.tintClipmap().missing(camera, reach, kMaxRequested)) {
        if (requested_.size() == kMaxRequested) break;
        if (requested_.insert(tile).second) more.push_back(tile);
    }
    if (more.empty()) return;
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), more.begin(), more.end());
    hasWork_.notify_all();
}

void TintView::wait(std::chrono::milliseconds atMost) {
    std::unique_lock lock(mutex_);
    hasFinished_.wait_for(lock, atMost, [this] { return !finished_.empty(); });
}

}  // namespace terrane::view
