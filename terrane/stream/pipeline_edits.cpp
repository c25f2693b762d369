// What edits do: light and mesh follow at once, on the thread that owns the world.
#include <algorithm>

#include "terrane/base/profile.h"
#include "terrane/mesh/remesh.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/stream/neighbourhood.h"
#include "terrane/world/block_update.h"

namespace terrane::stream {

using world::ChunkPos;

namespace {

// Edits are seen in the next frame, up to so many chunks a frame, and before all that is only meshed again; a
// chunk takes at most about 0.05 ms.
constexpr std::size_t kRemeshesPerUpdate = 64;

}  // namespace

bool ChunkPipeline::setBlock(world::BlockPos pos, world::BlockId id) {
    const std::vector<world::BlockUpdate> updates = world::updateBlock(parts_.world, parts_.blocks, pos, id);
    for (const world::BlockUpdate& u : updates) blockChanged(u.pos, u.before);
    return !updates.empty();
}

bool ChunkPipeline::setSmallData(world::BlockPos pos, std::uint16_t value) {
    if (!parts_.world.setSmallData(pos, value)) return false;
    dataChanged(pos);
    return true;
}

bool ChunkPipeline::setLargeData(world::BlockPos pos, world::LargeData data) {
    if (!parts_.world.setLargeData(pos, std::move(data))) return false;
    dataChanged(pos);
    return true;
}

void ChunkPipeline::blockChanged(world::BlockPos pos, world::BlockId before) {
    const ChunkPos chunk = world::chunkOf(pos);
    table_.blocksChanged(chunk);
    Extra& extra = extras_[chunk];
    extra.local = nullptr;
    if (!extra.editedAt) extra.editedAt = now_;
    // A block that changes several times stands once, as it was at first.
    const auto same = [&](const light::BlockEdit& e) { return e.pos == pos; };
    if (std::none_of(edits_.begin(), edits_.end(), same)) edits_.push_back({pos, before});
}

void ChunkPipeline::dataChanged(world::BlockPos pos) {
    const ChunkPos chunk = world::chunkOf(pos);
    Extra& extra = extras_[chunk];
    if (!extra.editedAt) extra.editedAt = now_;
    table_.blocksChanged(chunk);
    meshFirst(chunk, mesh::RegionSet{1} << (pos.z / meshOptions_.regionHeight));
}

void ChunkPipeline::meshFirst(ChunkPos pos, mesh::RegionSet regions) {
    toMesh_[pos] |= regions;
    meshFirst_.insert(pos);
}

void ChunkPipeline::applyEdits() {
    if (edits_.empty()) return;
    TERRANE_ZONE("edits");
    std::set<ChunkPos> edited;
    for (const light::BlockEdit& e : edits_) {
        for (const mesh::TouchedChunk& touched : mesh::regionsTouchedBy(e.pos, meshOptions_.regionHeight)) {
            meshFirst(touched.pos, touched.regions);
        }
        edited.insert(world::chunkOf(e.pos));
    }
    if (!relightIncrementally(edited)) relightFromScratch(edited);
    edits_.clear();
}

// False where something around an edit is not lit.
bool ChunkPipeline::relightIncrementally(const std::set<ChunkPos>& edited) {
    light::LitChunks around;
    for (const ChunkPos centre : edited) {
        for (const ChunkPos pos : neighbourhood(centre)) {
            if (!world::isInWorld(pos)) continue;
            const auto extra = extras_.find(pos);
            if (extra == extras_.end() || !extra->second.light) return false;
            around[pos] = {parts_.world.maybeChunkAt(pos), extra->second.light};
        }
    }
    thread_local light::LightScratch scratch;
    for (const light::LightChange& c : light::relight(around, edits_, parts_.lights, scratch)) {
        setLight(c.pos, around.at(c.pos).light, c.bricks);
        takeFirst_.insert(c.pos);
    }
    return true;
}

// At the edge of what is lit, where light that comes from beyond is not known.
void ChunkPipeline::relightFromScratch(const std::set<ChunkPos>& edited) {
    std::set<ChunkPos> lit;
    for (const ChunkPos centre : edited) {
        for (const ChunkPos pos : neighbourhood(centre)) {
            if (table_.is(pos, ChunkStage::Visible)) lit.insert(pos);
        }
    }
    for (const ChunkPos pos : lit) setLight(pos, lightOf(surroundings(pos), parts_.lights));
    takeFirst_.insert(lit.begin(), lit.end());
}

void ChunkPipeline::setLight(ChunkPos pos, light::ChunkLightPtr light, std::uint16_t bricks) {
    extras_[pos].light = light;
    if (!light) return;
    ChunkChange& changed = change(pos);
    changed.light = std::move(light);
    changed.bricks |= bricks;
}

// What was not taken yet stays, but for the regions that are newer now.
void ChunkPipeline::setMesh(ChunkPos pos, MeshPtr mesh, mesh::RegionSet regions) {
    ChunkChange& changed = change(pos);
    if (changed.mesh && regions != mesh::kAllRegions) {
        mesh = std::make_shared<const mesh::ChunkMesh>(mesh::withRegions(*changed.mesh, *mesh, regions));
    }
    changed.mesh = std::move(mesh);
    changed.regions |= regions;
}

void ChunkPipeline::askForMesh(ChunkPos pos) {
    ChunkChange& changed = change(pos);
    changed.mesh = nullptr;
    changed.regions = 0;
    changed.needsMesh = true;
}

// Whole chunks, and those that somebody is to mesh anyway.
bool ChunkPipeline::isMeshedElsewhere(ChunkPos pos, mesh::RegionSet regions) const {
    if (!leavesMeshesOut_) return false;
    const auto waiting = changes_.find(pos);
    return regions == mesh::kAllRegions || (waiting != changes_.end() && waiting->second.needsMesh);
}

void ChunkPipeline::remesh() {
    std::size_t count = 0;
    while (count < kRemeshesPerUpdate && !toMesh_.empty()) {
        const ChunkPos pos = meshFirst_.empty() ? toMesh_.begin()->first : *meshFirst_.begin();
        const mesh::RegionSet regions = toMesh_.extract(pos).mapped();
        const bool isEdited = meshFirst_.erase(pos) > 0;
        if (!table_.is(pos, ChunkStage::Visible)) continue;  // it will be meshed with the new blocks
        if (isEdited) takeFirst_.insert(pos);
        if (isMeshedElsewhere(pos, regions)) {
            askForMesh(pos);
            continue;
        }
        setMesh(pos, meshOf(surroundings(pos).chunks, parts_.blocks, meshOptions_, regions), regions);
        ++count;
    }
}

}  // namespace terrane::stream
