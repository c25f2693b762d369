#include "terrane/render/quads/quad_store.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "terrane/base/result.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

// Largest arena. Growing copies at most half of it, and at most this much is unused.
constexpr std::int64_t kArenaBytes = std::int64_t{1} << 28;
static_assert(kArenaBytes <= std::int64_t{1} << 30, "no buffer is larger than 1 GiB");
static_assert(kArenaBytes / shared::kQuadBytes <= shared::kFirstListedQuad,
              "numbers of quads and of places differ");
static_assert(kArenaBytes / shared::kQuadBytes * shared::kMaxArenas <= std::int64_t{1} << 32);

std::uint32_t reachableQuads() {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    const auto quads = static_cast<std::size_t>(std::min(blockBytes, kArenaBytes)) / shared::kQuadBytes;
    return static_cast<std::uint32_t>(std::min(quads, gpu::BufferTexture::maxElements()));
}

gpu::ArenaSizes arenaSizes(const QuadStoreSizes& sizes) {
    const std::uint32_t arena = sizes.arenaQuads > 0 ? sizes.arenaQuads : reachableQuads();
    return {.arena = arena, .first = std::min(sizes.firstQuads, arena), .count = sizes.maxArenas};
}

std::uint32_t quadsOf(std::span<const mesh::MeshSection> meshSections) {
    std::uint32_t count = 0;
    for (const mesh::MeshSection& meshSection : meshSections) count += mesh::quadCount(meshSection);
    return count;
}

}  // namespace

// Adjacent directions share a command: seven directions take at most four commands, or as many as there are
// directions.
BucketCommands mostCommands(std::span<const mesh::QuadRange, shared::kRangesPerMeshSection> ranges) {
    BucketCommands most{};
    for (std::uint32_t bucket = 0; bucket < shared::kDrawBuckets; ++bucket) {
        const std::uint32_t directions = bucket % 2 == 0 ? shared::kFaceDirections : 1;
        std::uint32_t used = 0, quads = 0;
        for (std::uint32_t k = 0; k < directions; ++k) {
            const std::uint32_t count = ranges[shared::firstRange(bucket) + k].count;
            used += count > 0;
            quads += count;
        }
        most[bucket] = std::min(used, 4u) + quads / shared::kMaxQuadsPerCommand;
    }
    return most;
}

namespace {

DrawnSections drawnOf(const mesh::MeshSection& meshSection) {
    const BucketCommands most = mostCommands(mesh::rangesOf(meshSection));
    return {mesh::quadCount(meshSection) > 0 ? 1u : 0u, std::accumulate(most.begin(), most.end(), 0u)};
}

}  // namespace

QuadStore::QuadStore(const QuadStoreSizes& sizes)
    : hasLight_(sizes.hasLight), ranges_(arenaSizes(sizes)), limits_(sizes.limits.ofDriver()) {
    assert(sizes.maxArenas <= shared::kMaxArenas && "culling has lists for no more");
    arenas_.push_back(makeArena(ranges_.arenas().front().capacity()));
}

QuadStore::Arena QuadStore::makeArena(std::uint32_t quads) const {
    Arena arena{gpu::Buffer(std::size_t{quads} * shared::kQuadBytes, GL_DYNAMIC_STORAGE_BIT, "quads"), {}};
    arena.texels = gpu::BufferTexture(arena.buffer, GL_RG32UI, "quads");
    if (!hasLight_) return arena;
    arena.light = gpu::Buffer(quads * sizeof(shared::QuadLight), GL_DYNAMIC_STORAGE_BIT, "light of quads");
    arena.lightTexels = gpu::BufferTexture(arena.light, GL_RG32UI, "light of quads");
    return arena;
}

void QuadStore::bindTexels(std::size_t arena) const {
    arenas_[arena].texels.bind(shared::kQuadsUnit);
    if (hasLight_) arenas_[arena].lightTexels.bind(shared::kQuadLightUnit);
}

bool QuadStore::set(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                    const mesh::MeshSectionSet& meshSections, std::span<const shared::QuadLight> light) {
    base::require(quadsOf(mesh.meshSections) == mesh.quads.size(),
                  "Renderer::setChunk: the mesh sections do not name each quad once");
    assert(light.size() == (hasLight_ ? mesh.quads.size() : 0) && "each quad has light, or none has");
    if (!replaceRanges(pos, mesh.meshSections, meshSections)) return false;
    if (mesh.quads.empty()) return true;
    const std::span<const mesh::MeshSection> stored = meshSectionsOf(pos);
    const auto lowest = std::ranges::find_if(mesh.meshSections, mesh::quadCount);
    const std::uint32_t first =
        mesh::firstQuad(*std::ranges::find(stored, lowest->bottom, &mesh::MeshSection::bottom));
    Arena& arena = arenas_[ranges_.arenaOf(first)];
    arena.buffer.uploadVector(std::size_t{ranges_.offsetOf(first)} * shared::kQuadBytes, mesh.quads);
    if (!arena.onCpu.empty()) std::ranges::copy(mesh.quads, arena.onCpu.begin() + ranges_.offsetOf(first));
    if (hasLight_)
        arena.light.upload(std::size_t{ranges_.offsetOf(first)} * sizeof(shared::QuadLight),
                           std::as_bytes(light));
    uploadedBytes_ += mesh.quads.size() * bytesPerQuad();
    return true;
}

bool QuadStore::reserve(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                        const mesh::MeshSectionSet& meshSections) {
    for (Arena& arena : arenas_) arena.onCpu.clear();
    return replaceRanges(pos, meshes, meshSections);
}

std::span<shared::Quad> QuadStore::quadsOnCpu(std::size_t arena) {
    Arena& a = arenas_[arena];
    if (a.onCpu.empty()) {
        a.onCpu.resize(a.buffer.sizeBytes() / shared::kQuadBytes);
        a.buffer.download(0, std::as_writable_bytes(std::span(a.onCpu)));
    }
    return a.onCpu;
}

mesh::ChunkMesh QuadStore::meshOf(world::ChunkPos pos) const {
    mesh::ChunkMesh mesh;
    for (const mesh::MeshSection& stored : meshSectionsOf(pos)) {
        const std::uint32_t first = mesh::firstQuad(stored), count = mesh::quadCount(stored);
        const Arena& arena = arenas_[ranges_.arenaOf(first)];
        const std::uint32_t offset = ranges_.offsetOf(first);
        std::vector<shared::Quad> quads(count);
        if (arena.onCpu.empty()) {
            arena.buffer.download(std::size_t{offset} * shared::kQuadBytes,
                                  std::as_writable_bytes(std::span(quads)));
        } else {
            std::copy_n(arena.onCpu.begin() + offset, count, quads.begin());
        }
        mesh.meshSections.push_back(mesh::movedTo(static_cast<std::uint32_t>(mesh.quads.size()), stored));
        for (const shared::Quad quad : quads)
            mesh.quads.push_back({quad.word0, quad.word1 & ~(shared::kQuadSeen | shared::kQuadNew)});
    }
    return mesh;
}

bool QuadStore::replaceRanges(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                              const mesh::MeshSectionSet& meshSections) {
    for (const mesh::MeshSection& meshSection : meshes) {
        base::require(meshSections.has(meshSection) || mesh::quadCount(meshSection) == 0,
                      "Renderer::setChunk: quads of a mesh section that is not set");
    }
    ChunkMeshSections& chunk = chunks_[pos];
    free(chunk, meshSections);
    const std::uint32_t count = quadsOf(meshes);
    std::optional<std::uint32_t> first = 0;
    if (count > 0) first = hasRoomFor(meshes) ? allocate(count) : std::nullopt;
    if (first) {
        const auto middle = static_cast<std::ptrdiff_t>(chunk.size());
        for (std::uint32_t next = *first; const mesh::MeshSection& meshSection : meshes) {
            if (mesh::quadCount(meshSection) == 0) continue;
            chunk.push_back(mesh::movedTo(next, meshSection));
            next += mesh::quadCount(meshSection);
            const DrawnSections added = drawnOf(meshSection);
            drawn_.meshSections += added.meshSections;
            drawn_.commands += added.commands;
        }
        std::ranges::inplace_merge(chunk, chunk.begin() + middle, {}, &mesh::MeshSection::bottom);
    }
    if (chunk.empty()) chunks_.erase(pos);
    return first.has_value();
}

void QuadStore::remove(world::ChunkPos pos) {
    const auto it = chunks_.find(pos);
    if (it == chunks_.end()) return;
    free(it->second, mesh::kAllMeshSections);
    chunks_.erase(it);
}

void QuadStore::free(ChunkMeshSections& chunk, const mesh::MeshSectionSet& meshSections) {
    std::erase_if(chunk, [&](const mesh::MeshSection& meshSection) {
        if (!meshSections.has(meshSection)) return false;
        ranges_.free(mesh::firstQuad(meshSection), mesh::quadCount(meshSection));
        const DrawnSections removed = drawnOf(meshSection);
        drawn_.meshSections -= removed.meshSections;
        drawn_.commands -= removed.commands;
        return true;
    });
}

bool QuadStore::hasRoomFor(std::span<const mesh::MeshSection> meshes) const {
    std::uint64_t meshSections = drawn_.meshSections, commands = drawn_.commands;
    for (const mesh::MeshSection& meshSection : meshes) {
        const DrawnSections added = drawnOf(meshSection);
        meshSections += added.meshSections;
        commands += added.commands;
    }
    return meshSections <= limits_.meshSections && commands <= limits_.commands;
}

std::span<const mesh::MeshSection> QuadStore::meshSectionsOf(world::ChunkPos pos) const {
    const auto it = chunks_.find(pos);
    return it == chunks_.end() ? std::span<const mesh::MeshSection>() : it->second;
}

std::optional<std::uint32_t> QuadStore::allocate(std::uint32_t count) {
    if (const auto first = ranges_.allocate(count)) return first;
    return grow(count) ? ranges_.allocate(count) : std::nullopt;
}

// Doubling copies each quad once or twice in all. The GPU frees the old buffer after drawing with it.
bool QuadStore::grow(std::uint32_t count) {
    const std::size_t bytes = bufferBytes(), room = maxBytes_ - std::min(maxBytes_, bytes);
    const auto growth = ranges_.planGrowth(count, room / bytesPerQuad());
    if (!growth) return false;
    Arena arena = makeArena(growth->capacity);
    if (growth->arena == arenas_.size()) {
        arenas_.push_back(std::move(arena));
    } else {
        peakBytes_ = std::max(peakBytes_, bytes + arena.buffer.sizeBytes() + arena.light.sizeBytes());
        Arena& old = arenas_[growth->arena];
        glCopyNamedBufferSubData(old.buffer.id(), arena.buffer.id(), 0, 0,
                                 static_cast<GLsizeiptr>(old.buffer.sizeBytes()));
        if (hasLight_)
            glCopyNamedBufferSubData(old.light.id(), arena.light.id(), 0, 0,
                                     static_cast<GLsizeiptr>(old.light.sizeBytes()));
        arena.onCpu = std::move(old.onCpu);
        if (!arena.onCpu.empty()) arena.onCpu.resize(growth->capacity);
        old = std::move(arena);
    }
    ranges_.grow(*growth);
    return true;
}

gpu::ArenaBuffers QuadStore::buffers() const {
    gpu::ArenaBuffers result{{}, ranges_.arenaSize()};
    for (const Arena& arena : arenas_) result.buffers.push_back(&arena.buffer);
    return result;
}

std::size_t QuadStore::bufferBytes() const {
    return static_cast<std::size_t>(ranges_.capacity()) * bytesPerQuad();
}

std::size_t QuadStore::usedBytes() const {
    return static_cast<std::size_t>(ranges_.capacity() - ranges_.freeTotal()) * bytesPerQuad();
}

}  // namespace terrane::render
