#include "terrane/net/client/remote_session.h"

#include <algorithm>
#include <utility>

namespace terrane::net {

RemoteStore::RemoteStore(store::WorldIdentity identity, gen::LevelGenerators generators)
    : identity_(std::move(identity)), generators_(std::move(generators)) {}

void RemoteStore::setDifference(world::ChunkPos pos, ChunkDifference difference) {
    const std::lock_guard lock(mutex_);
    if (difference.empty())
        differences_.erase(pos);
    else
        differences_[pos] = std::move(difference);
}

void RemoteStore::addDifference(world::ChunkPos pos, std::span<const ChangedBlock> newer) {
    if (newer.empty()) return;
    const std::lock_guard lock(mutex_);
    mergeInto(differences_[pos], newer);
}

ChunkDifference RemoteStore::difference(world::ChunkPos pos) const {
    const std::lock_guard lock(mutex_);
    const auto found = differences_.find(pos);
    return found == differences_.end() ? ChunkDifference() : found->second;
}

std::size_t RemoteStore::blockCount() const {
    const std::lock_guard lock(mutex_);
    std::size_t count = 0;
    for (const auto& [pos, difference] : differences_) count += difference.size();
    return count;
}

std::vector<world::ChunkPos> RemoteStore::positions() const {
    const std::lock_guard lock(mutex_);
    std::vector<world::ChunkPos> all;
    all.reserve(differences_.size());
    for (const auto& [pos, difference] : differences_) all.push_back(pos);
    return all;
}

store::LoadedChunk RemoteStore::load(world::ChunkPos pos) {
    const ChunkDifference known = difference(pos);
    if (known.empty()) return {};
    auto chunk = std::make_shared<world::Chunk>(generators_.generate(pos));
    applyDifference(*chunk, known);
    return {store::LoadedChunk::State::Present, std::move(chunk), store::Provenance::Edited, {}};
}

bool RemoteStore::contains(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    return differences_.contains(pos);
}

base::Result<std::vector<world::ChunkPos>> RemoteStore::editedChunks() {
    std::vector<world::ChunkPos> edited;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [pos, difference] : differences_)
            if (pos.level == 0) edited.push_back(pos);
    }
    std::ranges::sort(edited);
    return edited;
}

std::optional<std::string> RemoteStore::metadata(std::string_view name) {
    const std::lock_guard lock(mutex_);
    const auto found = metadata_.find(name);
    return found == metadata_.end() ? std::nullopt : std::optional(found->second);
}

store::SaveNumber RemoteStore::save(world::ChunkPos, world::ChunkPtr, store::Provenance) {
    return 0;
}

store::SaveNumber RemoteStore::setMetadata(std::string_view name, std::string value) {
    const std::lock_guard lock(mutex_);
    metadata_.insert_or_assign(std::string(name), std::move(value));
    return 0;
}

void RemoteStore::setDerivedRows(store::DerivedRows) {}

base::Result<void> RemoteStore::deriveAll(std::string_view) {
    return {};
}

base::Result<gen::Generator> offeredGenerator(const WorldOffer& offer, const world::BlockRegistry& blocks,
                                              const gen::GeneratorCatalogue& generators) {
    store::WorldIdentity own{offer.world.identity.seed, {}, 0, offer.world.identity.heights};
    auto graph = gen::makeGenerator(offer.world.identity.generator, blocks, gen::GraphRequest{0, own.heights},
                                    generators);
    WorldFingerprint client{own, 0, blocksHash(blocks)};
    if (graph) {
        own.generator = offer.world.identity.generator;
        own.generatorVersion = gen::versionOf(generators, own.generator);
        client = worldFingerprint(own, *graph, blocks);
    }
    const std::string difference = differenceOf(offer.world, client);
    // A missing generator shows up as a difference, unless the server claims the values of a missing one.
    if (!graph && difference.empty()) return tl::unexpected(graph.error());
    if (!difference.empty()) return base::fail(base::ErrorCode::Incompatible, "{}", difference);
    return gen::Generator(std::move(*graph), own.seed);
}

base::Result<RemoteSessionParts> remoteSessionParts(const store::WorldIdentity& identity,
                                                    std::shared_ptr<const world::BlockRegistry> blocks,
                                                    unsigned threads,
                                                    const gen::GeneratorCatalogue& generators) {
    const auto make = [&] {
        return gen::makeLevelGenerators(identity.generator, *blocks, identity.seed, generators,
                                        identity.heights);
    };
    auto forSession = make(), forStore = make();
    if (!forSession || !forStore) return tl::unexpected((!forSession ? forSession : forStore).error());
    auto store = std::make_unique<RemoteStore>(identity, std::move(*forStore));
    RemoteStore* const told = store.get();
    game::SessionParts parts{std::move(blocks), std::move(*forSession), std::move(store), threads};
    parts.storesGenerated = false;
    return RemoteSessionParts{std::move(parts), told};
}

}  // namespace terrane::net
