#include "terrane/render/quad_store.h"

#include <algorithm>

namespace terrane::render {
namespace {

constexpr std::uint32_t kFirstCapacity = 1u << 20;  // quads: 8 MiB, a landscape at view distance 16

gpu::Buffer quadBuffer(std::uint32_t quads) {
    return gpu::Buffer(std::size_t{quads} * shared::kQuadBytes, GL_DYNAMIC_STORAGE_BIT, "quads");
}

// 128 MiB of quads in Mesa's software renderer (a landscape at view distance 55), gigabytes elsewhere. No
// buffer is larger than 1 GiB.
std::uint32_t reachableQuads() {
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;
    return static_cast<std::uint32_t>(std::min<std::int64_t>(blockBytes, kMostBytes) / shared::kQuadBytes);
}

}  // namespace

QuadStore::QuadStore(std::uint32_t maxQuads)
    : maxQuads_(maxQuads > 0 ? maxQuads : reachableQuads()),
      buffer_(quadBuffer(std::min(kFirstCapacity, maxQuads_))),
      ranges_(std::min(kFirstCapacity, maxQuads_)) {}

bool QuadStore::set(world::ChunkPos pos, const mesh::ChunkMesh& mesh) {
    remove(pos);
    if (mesh.quads.empty()) return true;
    const auto count = static_cast<std::uint32_t>(mesh.quads.size());
    const std::optional<std::uint32_t> first = allocate(count);
    if (!first) return false;
    buffer_.uploadVector(std::size_t{*first} * shared::kQuadBytes, mesh.quads);
    chunks_.emplace(pos, ChunkQuads{*first, count, mesh.regions});
    return true;
}

void QuadStore::remove(world::ChunkPos pos) {
    const auto it = chunks_.find(pos);
    if (it == chunks_.end()) return;
    ranges_.free(it->second.first, it->second.count);
    chunks_.erase(it);
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
    ranges_.grow(capacity);
    return true;
}

std::size_t QuadStore::usedBytes() const {
    return std::size_t{ranges_.capacity() - ranges_.freeTotal()} * shared::kQuadBytes;
}

}  // namespace terrane::render
