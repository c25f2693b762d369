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
    // A quad's z is uint8 in a world of 0…255 and int16 in others.
    static base::Result<QuadFile> create(const std::filesystem::path& path, world::Heights heights);

    // Sorts the quads of each range: back ends emit them in different orders, and files must be equal.
    base::Result<void> append(world::ChunkPos pos, mesh::ChunkMesh& mesh);

    // Writes the header, which holds the number of quads.
    base::Result<void> finish();

  private:
    QuadFile(base::OutputFile file, const char* type);

    base::OutputFile file_;
    const char* type_;
    std::size_t headerBytes_;
    std::uint64_t sizeBytes_;
    std::size_t quadCount_ = 0;
};

// Writes one value per block of an area as a NumPy file, uint16 [x, y, z] from the world's bottom to its top,
// square by square. One thread.
class VolumeFile {
  public:
    // Fails if the whole volume does not fit on the disk, or if its size in bytes is no 64-bit integer.
    static base::Result<VolumeFile> create(const std::filesystem::path& path, const world::ChunkArea& area,
                                           world::Heights heights);

    // Fills the values of a column, upward; x and y count from the square's first block.
    using ColumnOf = std::function<void(int x, int y, std::span<std::uint16_t> values)>;
    base::Result<void> write(const world::ChunkArea& square, const ColumnOf& columnOf);

    base::Result<void> finish() { return file_.finish(); }

  private:
    VolumeFile(base::OutputFile file, const world::ChunkArea& area, world::Heights heights,
               std::size_t headerBytes)
        : file_(std::move(file)), area_(area), heights_(heights), headerBytes_(headerBytes) {}

    base::OutputFile file_;
    world::ChunkArea area_;
    world::Heights heights_;
    std::size_t headerBytes_;
};

}  // namespace terrane::io
