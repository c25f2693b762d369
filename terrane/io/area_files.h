// Writes the quads of an area as a NumPy file, chunk by chunk, one record per quad (docs/architecture.md).
// One thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include "terrane/base/output_file.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/world/coords.h"

namespace terrane::io {

class QuadFile {
  public:
    static base::Result<QuadFile> create(const std::filesystem::path& path);

    // Sorts the quads of each range: back ends emit them in different orders, and files must be equal.
    base::Result<void> append(world::ChunkPos pos, mesh::ChunkMesh& mesh);

    // Writes the header, which holds the number of quads.
    base::Result<void> finish();

  private:
    explicit QuadFile(base::OutputFile file);

    base::OutputFile file_;
    std::size_t headerBytes_;
    std::uint64_t sizeBytes_;
    std::size_t quadCount_ = 0;
};

// Writes one value per block of an area as a NumPy file, uint16 [x, y, z], square by square. One thread.
class VolumeFile {
  public:
    // Limit on the area: the size of the file in bytes is a 64-bit integer.
    static constexpr std::int64_t kMaxChunks = INT64_MAX / (world::kBlocksPerChunk * 2) - 1;

    // Fails if the whole volume does not fit on the disk.
    static base::Result<VolumeFile> create(const std::filesystem::path& path, const world::ChunkArea& area);

    // Fills the 256 values of a column, upward; x and y count from the square's first block.
    using ColumnOf = std::function<void(int x, int y, std::span<std::uint16_t, world::kChunkHeight> values)>;
    base::Result<void> write(const world::ChunkArea& square, const ColumnOf& columnOf);

    base::Result<void> finish() { return file_.finish(); }

  private:
    VolumeFile(base::OutputFile file, const world::ChunkArea& area, std::size_t headerBytes)
        : file_(std::move(file)), area_(area), headerBytes_(headerBytes) {}

    base::OutputFile file_;
    world::ChunkArea area_;
    std::size_t headerBytes_;
};

}  // namespace terrane::io
