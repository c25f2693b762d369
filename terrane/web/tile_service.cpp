#include "terrane/web/tile_service.h"

#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/result.h"

namespace terrane::web {

using map::MapTile;

struct TileService::Render {
    std::unordered_map<Ticket, Ready> waiting;
    base::JobHandle job;
};

namespace {

// Turns exceptions, such as out of memory, into errors, so that every request is answered.
base::Result<std::string> paintTile(map::MapPainter& painter, const MapTile& tile,
                                    std::span<const map::EditedChunk> edited) {
    try {
        return painter.paint(tile, edited);
    } catch (const std::exception& exception) {
        return base::fail("{}", base::textOf(exception));
    }
}

}  // namespace

TileService::TileService(Parts parts) : parts_(std::move(parts)), files_(parts_.maxBytes) {}

TileService::~TileService() {
    *isAlive_ = false;
    for (const auto& [tile, render] : renders_) render->job.cancel();
    parts_.jobs.waitIdle();
}

TileService::Ticket TileService::request(const MapTile& tile, Ready ready) {
    if (const TileFilePtr* file = files_.find(tile)) {
        ++statistics_.fromMemory;
        ready(*file);
        return 0;
    }
    RenderPtr& render = renders_[tile];
    if (!render) {
        if (renders_.size() > parts_.maxWaiting) {
            renders_.erase(tile);
            ++statistics_.refused;
            ready(base::fail(base::ErrorCode::Busy, "{} tiles wait to be painted", parts_.maxWaiting));
            return 0;
        }
        render = std::make_shared<Render>();
        start(tile, render);
    }
    const Ticket ticket = ++lastTicket_;
    render->waiting.emplace(ticket, std::move(ready));
    tickets_[ticket] = render;
    return ticket;
}

// Collects the edited chunks here, on the web's thread: the worker sees a consistent state.
void TileService::start(const MapTile& tile, const RenderPtr& render) {
    const auto edited = std::make_shared<const std::vector<map::EditedChunk>>(
        editedAmong(map::chunksFor(tile, parts_.painter.heights())));
    const auto work = [this, tile, render, edited, alive = isAlive_] {
        const auto begin = std::chrono::steady_clock::now();
        auto png = std::make_shared<base::Result<std::string>>(paintTile(parts_.painter, tile, *edited));
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        parts_.post([this, tile, render, png, seconds, alive] {
            if (*alive) finish(tile, render, std::move(*png), seconds);
        });
    };
    render->job = parts_.jobs.submit(0, work);
}

void TileService::finish(const MapTile& tile, const RenderPtr& render, base::Result<std::string> png,
                         double seconds) {
    const auto found = renders_.find(tile);
    const bool isCurrent = found != renders_.end() && found->second == render;
    if (isCurrent) renders_.erase(found);
    ++statistics_.painted;
    statistics_.paintSeconds += seconds;
    base::Result<TileFilePtr> result = tl::unexpected(base::Error{});
    if (png) {
        const auto tag = fmt::format("{:016x}", base::hash64(*png));
        const auto file = std::make_shared<const TileFile>(TileFile{std::move(*png), tag});
        if (isCurrent) files_.put(tile, file, file->png.size() + 200);
        result = file;
    } else {
        result = tl::unexpected(png.error());
    }
    // A callback may call request() again.
    for (auto& [ticket, ready] : std::exchange(render->waiting, {})) {
        tickets_.erase(ticket);
        ready(result);
    }
}

void TileService::cancel(Ticket ticket) {
    const auto found = tickets_.find(ticket);
    if (found == tickets_.end()) return;
    const RenderPtr render = found->second;
    tickets_.erase(found);
    render->waiting.erase(ticket);
    if (!render->waiting.empty() || !render->job.cancel()) return;
    ++statistics_.cancelled;
    std::erase_if(renders_, [&](const auto& entry) { return entry.second == render; });
}

// A render in progress is still delivered to its waiting requests, but not cached.
void TileService::invalidate(const MapTile& tile) {
    files_.erase(tile);
    renders_.erase(tile);
}

void TileService::addEdited(std::span<const world::ChunkPos> chunks) {
    for (const world::ChunkPos chunk : chunks)
        if (chunk.level == 0) edited_.add(chunk);
}

void TileService::invalidate(std::span<const world::ChunkPos> chunks) {
    for (const world::ChunkPos chunk : chunks)
        for (const MapTile& tile : map::tilesShowing(chunk, parts_.painter.heights())) invalidate(tile);
}

std::vector<map::EditedChunk> TileService::editedAmong(std::span<const world::ChunkPos> chunks) const {
    std::vector<map::EditedChunk> edited = edited_.among(chunks);
    for (map::EditedChunk& chunk : edited)
        if (chunk.pos.level == 0 && parts_.liveChunk) chunk.chunk = parts_.liveChunk(chunk.pos);
    return edited;
}

const TileStatistics& TileService::statistics() {
    statistics_.waiting = renders_.size();
    statistics_.bytes = files_.bytes();
    statistics_.count = files_.count();
    return statistics_;
}

}  // namespace terrane::web
