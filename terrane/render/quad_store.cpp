#include "terrane/render/quad_store.h"

#include <algorithm>

namespace terrane::render {
namespace {

constexpr std::uint32_t kFirstCapacity = 1u << 20;  // quads: 8 MiB, a landscape at view distance 16

gpu::Buffer quadBuffer(std::uint32_t quads) {
    return gpu::Buffer(std::size_t{quads} * shared::kQuadBytes, GL_DYNAMIC_STORAGE_BIT, "quads");
}

}  // namespace

QuadStore::QuadStore() : buffer_(quadBuffer(kFirstCapacity)), ranges_(kFirstCapacity) {}

void QuadStore::set(world::ChunkPos pos, const mesh::ChunkMesh& mesh) {
    remove(pos);
    if (mesh.quads.empty()) return;
    const auto count = static_cast<std::uint32_t>(mesh.quads.size());
    const std::uint32_t first = allocate(count);
    buffer_.uploadVector(std::size_t{first} * shared::kQuadBytes, mesh.quads);
    chunks_.emplace(pos, ChunkQuads{first, count, mesh.regions});
}

void QuadStore::remove(world::ChunkPos pos) {
    const auto it = chunks_.find(pos);
    if (it == chunks_.end()) return;
    ranges_.free(it->second.first, it->second.count);
    chunks_.erase(it);
}

std::uint32_t QuadStore::allocate(std::uint32_t count) {
    if (const auto first = ranges_.allocate(count)) return *first;
    const std::uint32_t oldCapacity = ranges_.capacity();
    const std::uint32_t capacity = oldCapacity + std::max(oldCapacity, count);
    gpu::Buffer larger = quadBuffer(capacity);
    glCopyNamedBufferSubData(buffer_.id(), larger.id(), 0, 0,
                             static_cast<GLsizeiptr>(std::size_t{oldCapacity} * shared::kQuadBytes));
    buffer_ = std::move(larger);
    ranges_.grow(capacity);
    return *ranges_.allocate(count);
}

std::size_t QuadStore::usedBytes() const {
    return std::size_t{ranges_.capacity() - ranges_.freeTotal()} * shared::kQuadBytes;
}

}  // namespace terrane::render
