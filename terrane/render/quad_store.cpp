#include "terrane/render/quad_store.h"

#include <algorithm>
#include <cassert>

#include "terrane/mesh/mesh_section_quads.h"

namespace terrane::render {
namespace {

constexpr std::uint32_t kFirstCapacity = 1u << 20;  // quads: 8 MiB, a landscape at view distance 16

gpu::BufferTexture texelsOf(const gpu::Buffer& quads) {
    return gpu::BufferTexture(quads, GL_RG32UI, "quads");
}

gpu::Buffer quadBuffer(std::uint32_t quads) {
    return gpu::Buffer(std::size_t{quads} * shared::kQuadBytes, GL_DYNAMIC_STORAGE_BIT, "quads");
}

// 128 MiB of quads in Mesa's software renderer (a landscape at view distance 55), gigabytes elsewhere. No
// buffer is larger than 1 GiB.
std::uint32_t reachableQuads() {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    constexpr std::int64_t kMaxBytes = std::int64_t{1} << 30;
    const auto quads = static_cast<std::size_t>(std::min(blockBytes, kMaxBytes)) / shared::kQuadBytes;
    return static_cast<std::uint32_t>(std::min(quads, gpu::BufferTexture::maxElements()));
}

std::uint32_t quadsOf(std::span<const mesh::MeshSection> meshSections) {
    std::uint32_t count = 0;
    for (const mesh::MeshSection& meshSection : meshSections) count += mesh::quadCount(meshSection);
    return count;
}

}  // namespace

QuadStore::QuadStore(std::uint32_t maxQuads)
    : maxQuads_(maxQuads > 0 ? maxQuads : reachableQuads()),
      buffer_(quadBuffer(std::min(kFirstCapacity, maxQuads_))),
      texels_(texelsOf(buffer_)),
      ranges_(std::min(kFirstCapacity, maxQuads_)) {}

bool QuadStore::set(world::ChunkPos pos, const mesh::ChunkMesh& mesh, mesh::MeshSectionSet meshSections) {
    if (!reserve(pos, mesh.meshSections, meshSections)) return false;
    if (mesh.quads.empty()) return true;
    const std::span<const mesh::MeshSection> stored = meshSectionsOf(pos);
    assert(quadsOf(mesh.meshSections) == mesh.quads.size() && "ranges name each quad once");
    std::size_t lowest = 0;
    while (!mesh::hasMeshSection(meshSections, lowest)) ++lowest;
    buffer_.uploadVector(std::size_t{mesh::firstQuad(stored[lowest])} * shared::kQuadBytes, mesh.quads);
    uploadedBytes_ += mesh.quads.size() * shared::kQuadBytes;
    return true;
}

bool QuadStore::reserve(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes,
                        mesh::MeshSectionSet meshSections) {
    ChunkMeshSections& chunk = chunks_[pos];
    if (chunk.size() != meshes.size()) {
        free(chunk, mesh::kAllMeshSections);
        chunk.assign(meshes.size(), {});
    }
    free(chunk, meshSections);
    const std::uint32_t count = quadsOf(meshes);
    const std::optional<std::uint32_t> first = count > 0 ? allocate(count) : 0;
    std::uint32_t next = first.value_or(0);
    for (std::size_t r = 0; first && r < meshes.size(); ++r) {
        assert((mesh::hasMeshSection(meshSections, r) || mesh::quadCount(meshes[r]) == 0) &&
               "nothing for the others");
        if (!mesh::hasMeshSection(meshSections, r)) continue;
        chunk[r] = mesh::movedTo(next, meshes[r]);
        next += mesh::quadCount(meshes[r]);
    }
    const auto isEmpty = [](const mesh::MeshSection& meshSection) {
        return mesh::quadCount(meshSection) == 0;
    };
    if (std::ranges::all_of(chunk, isEmpty)) chunks_.erase(pos);
    return first.has_value();
}

void QuadStore::remove(world::ChunkPos pos) {
    const auto it = chunks_.find(pos);
    if (it == chunks_.end()) return;
    free(it->second, mesh::kAllMeshSections);
    chunks_.erase(it);
}

void QuadStore::free(ChunkMeshSections& chunk, mesh::MeshSectionSet meshSections) {
    for (std::size_t r = 0; r < chunk.size(); ++r) {
        if (!mesh::hasMeshSection(meshSections, r)) continue;
        const std::uint32_t count = mesh::quadCount(chunk[r]);
        if (count > 0) ranges_.free(mesh::firstQuad(chunk[r]), count);
        chunk[r] = {};
    }
}

std::span<const mesh::MeshSection> QuadStore::meshSectionsOf(world::ChunkPos pos) const {
    const auto it = chunks_.find(pos);
    return it == chunks_.end() ? std::span<const mesh::MeshSection>() : it->second;
}

std::optional<std::uint32_t> QuadStore::allocate(std::uint32_t count) {
    if (const auto first = ranges_.allocate(count)) return first;
    return grow(count) ? ranges_.allocate(count) : std::nullopt;
}

// Doubling copies each quad once or twice in all. The GPU frees the old buffer when it has drawn with it.
bool QuadStore::grow(std::uint32_t count) {
    const std::uint64_t old = ranges_.capacity();
    const std::uint64_t wanted =
        std::min<std::uint64_t>(old + std::max<std::uint64_t>(old, count), maxQuads_);
    if (wanted < old + count) return false;
    const auto capacity = static_cast<std::uint32_t>(wanted);
    gpu::Buffer larger = quadBuffer(capacity);
    glCopyNamedBufferSubData(buffer_.id(), larger.id(), 0, 0,
                             static_cast<GLsizeiptr>(old * shared::kQuadBytes));
    buffer_ = std::move(larger);
    texels_ = texelsOf(buffer_);
    ranges_.grow(capacity);
    return true;
}

std::size_t QuadStore::usedBytes() const {
    return std::size_t{ranges_.capacity() - ranges_.freeTotal()} * shared::kQuadBytes;
}

}  // namespace terrane::render
