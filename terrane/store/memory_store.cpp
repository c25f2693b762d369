#include "terrane/store/memory_store.h"

#include "terrane/base/log.h"
#include "terrane/store/chunk_codec.h"

namespace terrane::store {

MemoryStore::MemoryStore(SaveFile below)
    : identity_(below.identity), settings_(below.settings.begin(), below.settings.end()) {
    below_.emplace(std::move(below));
    reader_.emplace(below_->database.path(), below_->readers);
}

LoadedChunk MemoryStore::load(world::ChunkPos pos) {
    {
        const std::lock_guard lock(mutex_);
        const auto found = chunks_.find(pos);
        if (found != chunks_.end())
            return {LoadedChunk::State::Present, found->second.chunk, found->second.origin, {}};
    }
    return below_ ? loadBelow(pos) : LoadedChunk{};
}

LoadedChunk MemoryStore::loadBelow(world::ChunkPos pos) {
    const auto stored = reader_->read(pos);
    if (stored && !*stored) return {};
    base::Result<world::Chunk> chunk =
        stored ? decodeChunk((*stored)->data, below_->ids) : tl::unexpected(stored.error());
    if (chunk) {
        return {LoadedChunk::State::Present,
                std::make_shared<world::Chunk>(std::move(*chunk)),
                (*stored)->origin,
                {}};
    }
    LoadedChunk damaged{LoadedChunk::State::Damaged, nullptr, Origin::Generated, {}};
    damaged.problem =
        fmt::format("{}: chunk {},{}: {}", below_->database.path(), pos.x, pos.y, chunk.error().message);
    base::logWarning("{}", damaged.problem);
    return damaged;
}

bool MemoryStore::contains(world::ChunkPos pos) {
    {
        const std::lock_guard lock(mutex_);
        if (chunks_.contains(pos)) return true;
    }
    if (!below_) return false;
    const auto found = reader_->contains(pos);
    return found && *found;
}

SaveNumber MemoryStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Origin origin) {
    const std::lock_guard lock(mutex_);
    const auto [entry, isNew] = chunks_.try_emplace(pos, WaitingChunk{chunk, origin});
    if (!isNew && origin >= entry->second.origin) entry->second = {std::move(chunk), origin};
    return ++saves_;
}

std::optional<std::string> MemoryStore::setting(std::string_view name) {
    const std::lock_guard lock(mutex_);
    const auto found = settings_.find(name);
    if (found == settings_.end()) return std::nullopt;
    return found->second;
}

SaveNumber MemoryStore::setSetting(std::string_view name, std::string value) {
    const std::lock_guard lock(mutex_);
    if (isIdentitySetting(name)) {
        base::logError("the setting {} belongs to the world's identity and stays as it is", name);
        return saves_;
    }
    settings_.insert_or_assign(std::string(name), std::move(value));
    return ++saves_;
}

SaveStatus MemoryStore::status() {
    const std::lock_guard lock(mutex_);
    return {saves_, saves_, 0, {}};
}

}  // namespace terrane::store
