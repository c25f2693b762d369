// A NumPy file of the quads of an area, one record a quad as docs/architecture.md describes them, written
// chunk by chunk. One thread.
#pragma once

#include "terrane/base/output_file.h"
#include "terrane/mesh/chunk_mesh.h"
#include "terrane/world/coords.h"

namespace terrane::app {

class QuadFile {
  public:
    static base::Result<QuadFile> create(const std::filesystem::path& path);

    // Sorts the quads of each range: each back end has an order of its own, and files are the same.
    base::Result<void> append(world::ChunkPos pos, mesh::ChunkMesh& mesh);

    // How many there are is written now.
    base::Result<void> finish();

  private:
    explicit QuadFile(base::OutputFile file);

    base::OutputFile file_;
    std::size_t headerBytes_;
    std::uint64_t sizeBytes_;
    std::size_t quadCount_ = 0;
};

}  // namespace terrane::app
