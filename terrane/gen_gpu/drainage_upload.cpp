#include "terrane/gen_gpu/drainage_upload.h"

namespace terrane::gen_gpu {

bool readsDrainage(const gen::GeneratorGraph& generator, const gen::PassGraph& pass) {
    for (gen::NodeId id = 0; id < pass.graph.size(); ++id) {
        const gen::Node& node = pass.graph.node(id);
        if (node.op == gen::Op::Noise && generator.noises[node.imm].kind == gen::NoiseKind::Drainage)
            return true;
    }
    return false;
}

DrainageBuffers uploadDrainage(gen::DrainageMaps& maps, std::size_t mapCount,
                               std::span<const world::ChunkPos> chunks) {
    std::vector<shared::DrainageList> lists;
    std::vector<shared::vec4> data(1);  // buffers are not empty
    gen::DrainageTile tile;
    for (const world::ChunkPos pos : chunks) {
        for (std::size_t map = 0; map < mapCount; ++map) {
            maps.prepare(tile, static_cast<std::uint32_t>(map), gen::sampleGrid(pos));
            lists.push_back({static_cast<shared::uint>(data.size()),
                             static_cast<shared::uint>(tile.segments.size()),
                             static_cast<shared::uint>(tile.lakes.size()), 0u});
            for (const shared::RiverSegment& s : tile.segments)
                data.insert(data.end(), {s.line, s.course, s.flow});
            data.insert(data.end(), tile.lakes.begin(), tile.lakes.end());
        }
    }
    return {gpu::Buffer(std::as_bytes(std::span(lists)), 0, "drainage lists"),
            gpu::Buffer(std::as_bytes(std::span(data)), 0, "drainage data")};
}

}  // namespace terrane::gen_gpu
