#include "terrane/store/overlay_store.h"

#include <utility>

namespace terrane::store {

OverlayStore::OverlayStore(std::unique_ptr<ReadableStore> below)
    : below_(std::move(below)), above_(below_->identity()) {}

LoadedChunk OverlayStore::load(world::ChunkPos pos) {
    LoadedChunk loaded = above_.load(pos);
    return loaded.state == LoadedChunk::State::Absent ? below_->load(pos) : loaded;
}

std::vector<LoadedChunk> OverlayStore::loadMany(std::span<const world::ChunkPos> positions) {
    std::vector<LoadedChunk> loaded = above_.loadMany(positions);
    std::vector<world::ChunkPos> missing;
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (loaded[k].state == LoadedChunk::State::Absent) missing.push_back(positions[k]);
    if (missing.empty()) return loaded;
    auto next = below_->loadMany(missing);
    auto from = next.begin();
    for (LoadedChunk& chunk : loaded)
        if (chunk.state == LoadedChunk::State::Absent) chunk = std::move(*from++);
    return loaded;
}

bool OverlayStore::contains(world::ChunkPos pos) {
    return above_.contains(pos) || below_->contains(pos);
}

std::optional<std::string> OverlayStore::metadata(std::string_view name) {
    auto value = above_.metadata(name);
    return value ? value : below_->metadata(name);
}

SaveNumber OverlayStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    // contains() first: mostly nothing is there, and nothing is read.
    if (provenance == Provenance::Generated && !above_.contains(pos) && below_->contains(pos)) {
        LoadedChunk loaded = below_->load(pos);
        if (loaded.chunk && loaded.provenance == Provenance::Edited)
            return above_.save(pos, std::move(loaded.chunk), Provenance::Edited);
    }
    return above_.save(pos, std::move(chunk), provenance);
}

SaveNumber OverlayStore::setMetadata(std::string_view name, std::string value) {
    return above_.setMetadata(name, std::move(value));
}

}  // namespace terrane::store
