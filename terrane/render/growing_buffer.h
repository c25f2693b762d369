// Buffers that are replaced by one of twice the needed size when they are too small, and the memory needed
// for it.
#pragma once

#include <cstddef>

#include "terrane/gpu/buffer.h"

namespace terrane::render {

// Size of the buffer that replaces `buffer`; 0 if `buffer` is large enough.
inline std::size_t grownBytes(const gpu::Buffer& buffer, std::size_t neededBytes) {
    return neededBytes > buffer.sizeBytes() ? 2 * neededBytes : 0;
}

// Bytes of the buffer and of its replacement: both exist until the GPU has used the old one.
inline std::size_t bytesWhileGrowing(const gpu::Buffer& buffer, std::size_t neededBytes) {
    return buffer.sizeBytes() + grownBytes(buffer, neededBytes);
}

}  // namespace terrane::render
