// Writes the quads of an area as a NumPy file, chunk by chunk, one record per quad (docs/architecture.md).
// One thread.
#pragma once

#include "terrane/base/output_file.h"
#include "terrane/mesh/chunk_mesh.h"
#include "terrane/world/coords.h"

namespace terrane::app {

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

}  // namespace terrane::app
