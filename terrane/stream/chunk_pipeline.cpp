#include "terrane/stream/chunk_pipeline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <set>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/mesh/remesh.h"
#include "terrane/stream/lighting.h"
#include "terrane/stream/meshing.h"
#include "terrane/stream/residency.h"

namespace terrane::stream {

using world::ChunkPos;
using world::ChunkPtr;

namespace {

// Edited chunks that are meshed in one update, before all others, so that edits are visible in the next
// frame; a chunk takes at most about 0.05 ms.
constexpr std::size_t kEditedMeshesPerUpdate = 64;

// Chunks that a batch lighter gets at once. At most two such batches wait or are in progress.
constexpr std::size_t kLightBatch = 64;
// The longest wait for a batch, since batches end without a signal.
constexpr std::chrono::milliseconds kBatchPause{1};

}  // namespace

ChunkPipeline::ChunkPipeline(const PipelineParts& parts)
    : parts_(parts), beyond_(borderChunk(parts.blocks, parts.world.heights())), workers_(parts_) {
    if (parts_.batchGenerator) parts_.source.generator = nullptr;
    table_.heights = parts_.world.heights();
}

ChunkPipeline::~ChunkPipeline() {
    saveAll();
}

void ChunkPipeline::setView(ChunkPos center, int viewDistance, glm::vec2 direction, int horizon) {
    base::require(viewDistance >= 0, "ChunkPipeline::setView: a negative view distance");
    const bool isOther = stream::setView(table_, center, viewDistance, direction);
    const TileView before = std::exchange(tileView_, {center, viewDistance, horizon});
    remeshBorders(table_, before, tileView_);
    if (!isOther) return;
    for (const ChunkPos pos : popHidden(table_)) changes_.hide(pos);
    cancelLoads();
}

// A batch generator makes whole chunks.
void ChunkPipeline::setCameraHeight(std::optional<int> z) {
    const bool isPartial = parts_.source.generator && hasPartialChunks(table_.heights);
    stream::setCameraHeight(table_, isPartial ? z : std::nullopt);
}

void ChunkPipeline::hideAll() {
    for (const ChunkPos pos : popVisible(table_)) changes_.hide(pos);
}

// Cancels loads that wait for a worker; running ones go on.
void ChunkPipeline::cancelLoads() {
    std::vector<ChunkPos> cancelled;
    for (auto& [pos, record] : table_.records) {
        if (!record.load || !mayCancelLoad(table_, pos)) continue;
        if (record.load.cancel()) cancelled.push_back(pos);
    }
    for (const ChunkPos pos : cancelled) abandonLoad(table_, pos);
}

void ChunkPipeline::setMeshOptions(const mesh::MeshOptions& options) {
    if (options == meshOptions_) return;
    meshOptions_ = options;
    for (auto& [pos, record] : table_.records) {
        record.isOutdated = true;  // running jobs have the old options
        requestWholeMesh(table_, pos);
    }
}

mesh::MeshBlocks ChunkPipeline::meshBlocks(ChunkPos pos) const {
    const ChunkNeighborhood around = this->around(pos);
    const ChunkRecord* record = findRecord(table_, pos);
    return record && record->light ? closeCaves(around, *record->light, parts_.blocks) : around.meshed;
}

// The input for light and mesh of the chunk.
ChunkNeighborhood ChunkPipeline::around(ChunkPos pos) const {
    ChunkNeighborhood around = neighborhoodOf(table_, parts_.world, pos);
    around.openSides = openSides(tileView_, pos);
    for (std::size_t side = 0; side < 4; ++side)
        if ((around.openSides >> side & 1) != 0) around.meshed[1 + side] = beyond_;
    return around;
}

void ChunkPipeline::update(Time now) {
    TERRANE_ZONE("pipeline update");
    sinceUpdate_ = now - now_;
    now_ = now;
    takeResults();
    if (parts_.batchGenerator) exchangeChunks();
    if (parts_.batchLighter) exchangeLight();
    relight();
    meshEdits();
    if (now >= nextHousekeeping_) runHousekeeping();
    submitLoads();
    submitLighting();
    submitDepths();
    submitMeshes();
}

void ChunkPipeline::takeResults() {
    const WorkerResults::Lists done = workers_.takeResults();
    for (const WorkerResults::Load& load : done.loads) {
        // The result of a job that ran although it was cancelled.
        if (!isAt(table_, load.pos, ChunkStage::Loading)) continue;
        if (load.read) {
            onLoaded(load.pos, load.read, load.localLight);
        } else {
            findRecord(table_, load.pos)->load = {};  // from here on it cannot be cancelled
            toGenerate_.push_back(load.pos);
        }
    }
    for (const WorkerResults::Deepened& deepened : done.deepened) onDeepened(deepened);
    for (const WorkerResults::Lit& lit : done.lit) onLit(lit.pos, lit.light, lit.mesh);
    for (const WorkerResults::Meshed& meshed : done.meshed) {
        if (finishMeshJob(table_, meshed.job)) {
            changes_.setMesh(meshed.job.pos, meshed.mesh, mesh::kAllMeshSections);
        }
    }
}

void ChunkPipeline::onLoaded(ChunkPos pos, ReadChunk read, LocalLightPtr local) {
    ChunkRecord& record = *findRecord(table_, pos);
    record.load = {};
    record.localLight = std::move(local);
    const LoadedDepths depths{read.chunk->lowestMade(), read.lowestOpen};
    parts_.world.insert(pos, std::move(read.chunk));
    if (notesLoaded_) loaded_.push_back(pos);
    finishLoad(table_, pos, now_, depths);
}

void ChunkPipeline::onDeepened(const WorkerResults::Deepened& deepened) {
    const ChunkPos pos = deepened.job.pos;
    const auto& [deeper, lowestOpen] = deepened.deeper;
    if (!finishDepthJob(table_, pos, {deeper->lowestMade(), lowestOpen})) return;
    const bool isSame = parts_.world.maybeChunkAt(pos) == deepened.former;
    if (isSame)
        parts_.world.insert(pos, deeper);
    else
        parts_.world.makeDeeper(pos, *deeper);
    findRecord(table_, pos)->localLight = isSame ? deepened.localLight : nullptr;
    invalidateLighting(table_, pos);
    updateDepthAround(table_, pos);
}

// Finds the lowest open sections of edited chunks again.
void ChunkPipeline::findOpenSections(std::span<const world::BlockEdit> edits) {
    std::set<ChunkPos> edited;
    for (const world::BlockEdit& edit : edits) edited.insert(world::chunkOf(edit.pos));
    for (const ChunkPos pos : edited) {
        ChunkRecord* record = findRecord(table_, pos);
        const world::ChunkPtr chunk = parts_.world.maybeChunkAt(pos);
        if (!record || !chunk) continue;
        const int before = std::exchange(record->lowestOpen, light::lowestOpenSection(*chunk, parts_.lights));
        if (record->lowestOpen < before) updateDepthAround(table_, pos);
    }
}

void ChunkPipeline::onLit(ChunkPos pos, light::ChunkLightPtr light, MeshPtr mesh) {
    if (!finishLighting(table_, pos)) return;
    ChunkRecord& record = *findRecord(table_, pos);
    record.light = light;
    record.meshJob = 0;  // this mesh is newer
    changes_.setLight(pos, std::move(light));
    if (mesh) {
        changes_.setMesh(pos, std::move(mesh), mesh::kAllMeshSections);
    } else {
        changes_.requestMesh(pos);
    }
    dropLocalLightAround(pos);
}

// A chunk's local light is needed until it and its neighbors are lit.
void ChunkPipeline::dropLocalLightAround(ChunkPos pos) {
    const auto isLit = [&](ChunkPos at) {
        return isAt(table_, at, ChunkStage::Visible) || !world::isInWorld(at);
    };
    for (const ChunkPos at : neighborhood(pos)) {
        ChunkRecord* record = findRecord(table_, at);
        if (!record || !record->localLight) continue;
        if (std::ranges::all_of(neighborhood(at), isLit)) record->localLight = nullptr;
    }
}

// The number of jobs that may be added to the running ones in this update.
std::size_t ChunkPipeline::roomFor(std::size_t running) const {
    const std::size_t limit = workers_.jobLimit(sinceUpdate_);
    return limit - std::min(limit, running);
}

void ChunkPipeline::submitLoads() {
    const std::size_t loading = countOf(table_, ChunkStage::Loading) - toGenerate_.size();
    for (const ChunkPos pos : popLoadRequests(table_, roomFor(loading))) {
        // Chunks beyond the view and its ring, such as all chunks of a server, are not lit.
        ChunkRecord& record = *findRecord(table_, pos);
        const int section = record.isRequested ? table_.heights.firstSection() : depthToLoad(table_, pos);
        record.load = workers_.submitLoad(urgency(table_.view, pos), pos, parts_.source, section,
                                          isNeeded(table_.view, pos));
    }
}

void ChunkPipeline::submitDepths() {
    for (const DepthJob& job : popDepthJobs(table_, roomFor(table_.depthJobCount)))
        workers_.submitDepth(urgency(table_.view, job.pos), job, parts_.world.maybeChunkAt(job.pos),
                             parts_.source);
}

void ChunkPipeline::exchangeChunks() {
    gen::BatchGenerator& generator = *parts_.batchGenerator;
    while (!toGenerate_.empty()) {
        const std::vector<ChunkPos> requests(toGenerate_.begin(), toGenerate_.end());
        const std::size_t taken = generator.submit(requests);
        if (taken == 0) break;
        toGenerate_.erase(toGenerate_.begin(), toGenerate_.begin() + static_cast<long>(taken));
        generating_ += taken;
    }
    for (gen::GeneratedChunk& generated : generator.take(false)) {
        --generating_;
        storeGenerated(parts_.source, generated.pos, generated.chunk);
        if (parts_.batchLighter) {
            onLoaded(generated.pos, {std::move(generated.chunk), table_.heights.endSection()}, nullptr);
        } else {
            workers_.submitLocalLight(urgency(table_.view, generated.pos), generated.pos,
                                      std::move(generated.chunk));
        }
    }
}

void ChunkPipeline::exchangeLight() {
    light::BatchLighter& lighter = *parts_.batchLighter;
    while (!toLight_.empty()) {
        std::vector<light::LightRequest> requests;
        for (std::size_t k = 0; k < std::min(toLight_.size(), kLightBatch); ++k) {
            requests.push_back({toLight_[k], around(toLight_[k]).chunks});
        }
        const std::size_t taken = lighter.submit(requests);
        if (taken == 0) break;
        toLight_.erase(toLight_.begin(), toLight_.begin() + static_cast<long>(taken));
        lighting_ += taken;
    }
    for (light::LightResult& lit : lighter.take(false)) {
        --lighting_;
        auto light = std::make_shared<const light::ChunkLight>(std::move(lit.light));
        if (parts_.meshing == MeshPolicy::Caller) {
            onLit(lit.pos, std::move(light), nullptr);
        } else {
            workers_.submitFirstMesh(urgency(table_.view, lit.pos) - 1, lit.pos, std::move(light),
                                     around(lit.pos), meshOptions_);
        }
    }
}

void ChunkPipeline::waitForWorkers(std::chrono::milliseconds timeout) {
    workers_.waitForAny(generating_ + lighting_ > 0 ? std::min(timeout, kBatchPause) : timeout);
}

void ChunkPipeline::submitLighting() {
    std::size_t room = roomFor(countOf(table_, ChunkStage::Lighting) + table_.lightAgainCount);
    if (parts_.batchLighter) room = 2 * kLightBatch - std::min(2 * kLightBatch, toLight_.size() + lighting_);
    for (const ChunkPos pos : popLightingRequests(table_, room)) {
        if (parts_.batchLighter) {
            toLight_.push_back(pos);
            continue;
        }
        // Before loads of equal urgency: chunks on screen free memory.
        workers_.submitLighting(urgency(table_.view, pos) - 1, pos, around(pos), meshOptions_);
    }
}

void ChunkPipeline::submitMeshes() {
    for (const MeshJob& job : popMeshJobs(table_, roomFor(table_.meshJobCount))) {
        if (parts_.meshing == MeshPolicy::Workers) {
            workers_.submitMesh(urgency(table_.view, job.pos), job, findRecord(table_, job.pos)->light,
                                around(job.pos), meshOptions_);
        } else if (finishMeshJob(table_, job)) {
            changes_.requestMesh(job.pos);
        }
    }
}

void ChunkPipeline::onEdits(std::span<const world::BlockEdit> edits) {
    ChunkRecord* record = nullptr;
    ChunkPos chunk;
    for (const world::BlockEdit& edit : edits) {
        if (!record || chunk != world::chunkOf(edit.pos)) {
            chunk = world::chunkOf(edit.pos);
            record = findRecord(table_, chunk);
            assert(record && "a chunk in the world has a record");
            if (!record->editedAt) record->editedAt = now_;
            requestDepth(table_, chunk, table_.heights.firstSection());  // saves have whole chunks
            invalidateLighting(table_, chunk);
        }
        if (edit.before == edit.after) {  // only its state or data changed
            mesh::MeshSectionSet own;
            own.add(edit.pos.z >> 3);
            requestEditedMesh(table_, chunk, own);
        } else {
            record->localLight = nullptr;
            toRelight_.add(edit);
        }
    }
}

void ChunkPipeline::relight() {
    if (toRelight_.edits.empty()) return;
    TERRANE_ZONE("edits");
    const std::vector<world::BlockEdit> edits = std::exchange(toRelight_, {}).edits;
    std::map<ChunkPos, mesh::MeshSectionSet> touched;
    for (const world::BlockEdit& edit : edits) {
        for (const auto& [chunk, meshSections] : mesh::meshSectionsTouchedBy(edit.pos))
            touched[chunk] |= meshSections;
    }
    if (table_.nearDepth) findOpenSections(edits);
    for (const auto& [chunk, meshSections] : touched) requestEditedMesh(table_, chunk, meshSections);
    for (const light::LightChange& change : relightEdits(table_, parts_.world, edits, parts_.lights)) {
        changes_.setLight(change.pos, findRecord(table_, change.pos)->light, change.bricks);
        changes_.prioritize(change.pos);
    }
}

void ChunkPipeline::meshEdits() {
    for (const MeshRequest& request : popEditedMeshes(table_, kEditedMeshesPerUpdate)) {
        changes_.prioritize(request.pos);
        showMesh(request.pos, request.meshSections);
    }
}

// If the caller makes meshes, it makes those of whole chunks, and those that it was already asked for.
void ChunkPipeline::showMesh(ChunkPos pos, mesh::MeshSectionSet meshSections) {
    if (parts_.meshing == MeshPolicy::Caller &&
        (meshSections == mesh::kAllMeshSections || changes_.isMeshRequested(pos))) {
        return changes_.requestMesh(pos);
    }
    changes_.setMesh(pos, meshOf(meshBlocks(pos), parts_.blocks, meshOptions_, meshSections), meshSections);
}

// Saves chunks some time after their edits, and unloads chunks that nobody needs.
void ChunkPipeline::runHousekeeping() {
    nextHousekeeping_ = now_ + kHousekeepingInterval;
    for (auto& [pos, record] : table_.records) {
        if (record.editedAt && now_ - *record.editedAt >= kSaveDelay) save(pos, record);
    }
    for (const ChunkPos pos : findUnneeded(table_, now_)) {
        if (!save(pos, *findRecord(table_, pos))) continue;
        unload(table_, pos);
        parts_.world.erase(pos);
    }
}

// False if it may not be saved yet.
bool ChunkPipeline::save(ChunkPos pos, ChunkRecord& record) {
    if (!record.editedAt) return true;
    if (maySave_ && !maySave_(pos)) return false;
    record.editedAt.reset();
    if (parts_.source.store) parts_.source.store->save(pos, wholeChunk(pos), store::Provenance::Edited);
    return true;
}

// Edited chunks are made whole; one that is saved before that is completed here.
ChunkPtr ChunkPipeline::wholeChunk(ChunkPos pos) const {
    ChunkPtr chunk = parts_.world.maybeChunkAt(pos);
    const int first = table_.heights.firstSection();
    if (chunk->isMade(first)) return chunk;
    auto whole = std::make_shared<world::Chunk>(*chunk);
    whole->makeDeeper(parts_.source.generator->generate(pos));
    return whole;
}

bool ChunkPipeline::isUnsaved(ChunkPos pos) const {
    const ChunkRecord* record = findRecord(table_, pos);
    return record && record->editedAt;
}

std::vector<ChunkPos> ChunkPipeline::takeLoaded() {
    notesLoaded_ = true;
    return std::exchange(loaded_, {});
}

void ChunkPipeline::saveAll() {
    for (auto& [pos, record] : table_.records) save(pos, record);
}

void ChunkPipeline::resendLight() {
    for (const auto& [pos, record] : table_.records) {
        if (record.light) changes_.setLight(pos, record.light);
    }
}

ChunkPtr ChunkPipeline::maybeLoadChunkAt(ChunkPos pos) {
    base::require(pos.level == 0 && world::isInWorld(pos),
                  "ChunkPipeline: chunks of level 0 in the world can be loaded");
    requestChunk(table_, pos, now_);
    ChunkPtr chunk = parts_.world.maybeChunkAt(pos);
    return chunk && chunk->isMade(table_.heights.firstSection()) ? chunk : nullptr;
}

ChunkPtr ChunkPipeline::chunkAt(ChunkPos pos) {
    for (;;) {
        if (ChunkPtr chunk = maybeLoadChunkAt(pos)) return chunk;
        update(now_);
        waitForWorkers(std::chrono::milliseconds(10));
    }
}

std::optional<light::LightValue> ChunkPipeline::lightAt(world::BlockPos pos) const {
    if (!parts_.world.heights().contains(pos.z)) return std::nullopt;
    const ChunkRecord* record = findRecord(table_, world::chunkOf(pos));
    if (!record || !record->light) return std::nullopt;
    return record->light->at(world::blockIndex(pos));
}

std::size_t ChunkPipeline::queuedCount() const {
    return countOf(table_, ChunkStage::Loading) + countOf(table_, ChunkStage::Lighting) + table_.meshJobCount;
}

Progress ChunkPipeline::progress() const {
    const std::size_t deeper = table_.toDeepen.size() + table_.depthJobCount;
    const std::size_t again = table_.toLightAgain.size() + table_.lightAgainCount;
    return {table_.chunksInView, table_.visibleInView,
            pendingMeshes(table_) + toRelight_.edits.size() + pendingLoads(table_) + deeper + again};
}

std::size_t ChunkPipeline::localLightBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, record] : table_.records) {
        bytes += record.localLight ? record.localLight->memoryBytes() : 0;
    }
    return bytes;
}

std::size_t ChunkPipeline::lightBytes() const {
    std::size_t bytes = 0;
    for (const auto& [pos, record] : table_.records) bytes += record.light ? record.light->memoryBytes() : 0;
    return bytes;
}

}  // namespace terrane::stream
