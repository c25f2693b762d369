// Chunks of the overworld for the tests of the GPU mesher.
#pragma once

#include <stdexcept>
#include <vector>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/content.h"

namespace terrane::mesh_gpu {

// Generated chunks and a ring around them.
struct Overworld {
    explicit Overworld(int side) : width(side + 2) {
        const auto graph = gen::makeGenerator("overworld", contentBlocks());
        if (!graph) throw std::runtime_error(graph.error().message);
        const gen::Generator generator(*graph, 12345);
        for (int k = 0; k < width * width; ++k) {
            chunks.push_back(generator.generate({k % width - 30, k / width + 11}));
        }
    }
    std::vector<mesh::MeshInput> inputs(const mesh::MeshOptions& options) const {
        const auto at = [&](int x, int y) { return &chunks[static_cast<std::size_t>(x + y * width)]; };
        std::vector<mesh::MeshInput> all;
        for (int y = 1; y + 1 < width; ++y) {
            for (int x = 1; x + 1 < width; ++x) {
                all.push_back({at(x, y),
                               {at(x - 1, y), at(x + 1, y), at(x, y - 1), at(x, y + 1)},
                               &contentBlocks(),
                               options});
            }
        }
        return all;
    }

    int width;
    std::vector<world::Chunk> chunks;
};

}  // namespace terrane::mesh_gpu
