// terrane dump: blocks, light or quads of an area as a NumPy file, so that anyone can check them from
// outside.
#include <algorithm>
#include <cstring>
#include <memory>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/open_session.h"
#include "apps/terrane/options.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/npy.h"
#include "terrane/content/built_in.h"
#include "terrane/stream/area_chunks.h"

namespace terrane::app {
namespace {

enum class What { Blocks, Light, Quads };

struct DumpOptions {
    WorldOptions world;
    std::optional<world::ChunkArea> area;
    What what = What::Blocks;
    std::string output;
    SaveOptions save;
    Backend backend = Backend::Auto;
    mesh::MeshOptions mesh;
};

// The file is made in memory, 128 KiB a chunk, and written from a copy: 4,096 chunks take about 1 GiB.
constexpr std::int64_t kMaxChunksInFile = 4096;

// The area and one chunk around it, which light and meshes need.
class LoadedArea {
  public:
    LoadedArea(const world::ChunkArea& area)
        : area_(area), width_(area.x1 - area.x0 + 2), height_(area.y1 - area.y0 + 2) {}

    // From the save, which may be null, else generated.
    base::Result<void> load(store::ChunkStore* save, const gen::Generator& generator, base::JobSystem& jobs) {
        std::vector<world::ChunkPos> positions;
        for (int k = 0; k < width_ * height_; ++k)
            positions.push_back({area_.x0 - 1 + k % width_, area_.y0 - 1 + k / width_});
        auto chunks = stream::chunksAt(positions, save, generator, jobs);
        if (!chunks) return tl::unexpected(chunks.error());
        chunks_ = std::move(*chunks);
        return {};
    }

    // x and y count from the area's first chunk; -1 and the size are there too.
    const world::Chunk& chunk(int x, int y) const {
        return chunks_[static_cast<std::size_t>(x + 1 + (y + 1) * width_)];
    }
    int chunksX() const { return width_ - 2; }
    int chunksY() const { return height_ - 2; }

  private:
    world::ChunkArea area_;
    int width_, height_;
    std::vector<world::Chunk> chunks_;
};

// uint16 [x, y, z].
template <class ValueAt>
base::NpyArray volume(const LoadedArea& area, ValueAt valueAt) {
    const int sizeX = area.chunksX() * world::kChunkSize, sizeY = area.chunksY() * world::kChunkSize;
    base::NpyArray array{
        "<u2", {static_cast<std::size_t>(sizeX), static_cast<std::size_t>(sizeY), world::kChunkHeight}, {}};
    array.data.reserve(static_cast<std::size_t>(sizeX) * static_cast<std::size_t>(sizeY) *
                       world::kChunkHeight * 2);
    for (int x = 0; x < sizeX; ++x) {
        for (int y = 0; y < sizeY; ++y) {
            for (int z = 0; z < world::kChunkHeight; ++z) {
                const std::uint16_t value = valueAt(x, y, z);
                array.data.push_back(static_cast<char>(value & 255));
                array.data.push_back(static_cast<char>(value >> 8));
            }
        }
    }
    return array;
}

base::NpyArray dumpBlocks(const LoadedArea& area) {
    return volume(area, [&](int x, int y, int z) {
        return area.chunk(x / world::kChunkSize, y / world::kChunkSize)
            .block(world::blockIndex(x & 15, y & 15, z));
    });
}

base::NpyArray dumpLight(const LoadedArea& area, light::AreaSolver& solver) {
    light::LightArea around{area.chunksX() + 2, area.chunksY() + 2, {}};
    for (int y = -1; y <= area.chunksY(); ++y) {
        for (int x = -1; x <= area.chunksX(); ++x) around.chunks.push_back(&area.chunk(x, y));
    }
    const std::vector<light::ChunkLight> lights = solver.solve(around);
    return volume(area, [&](int x, int y, int z) {
        const int chunk = x / world::kChunkSize + 1 + around.chunksX * (y / world::kChunkSize + 1);
        return lights[static_cast<std::size_t>(chunk)].get(x & 15, y & 15, z);
    });
}

// One record a quad, as docs/architecture.md describes them.
constexpr const char* kQuadType =
    "[('chunk_x','<i4'),('chunk_y','<i4'),('x','|u1'),('y','|u1'),('z','|u1'),('shape_face','|u1'),"
    "('extent_u','|u1'),('extent_v','|u1'),('material','<u2'),('context','|u1'),('group','|u1')]";

void appendQuad(std::string& data, world::ChunkPos pos, shared::Quad quad,
                std::array<int, 2> bucketAndDirection) {
    const auto number = [&](auto value) {
        char bytes[sizeof(value)];
        std::memcpy(bytes, &value, sizeof(value));
        data.append(bytes, sizeof(value));
    };
    const auto byte = [&](shared::uint value) { data.push_back(static_cast<char>(value)); };
    number(pos.x);
    number(pos.y);
    byte(shared::quadX(quad));
    byte(shared::quadY(quad));
    byte(shared::quadZ(quad));
    byte(shared::quadShapeFace(quad));
    byte(shared::quadExtentU(quad));
    byte(shared::quadExtentV(quad));
    number(static_cast<std::uint16_t>(shared::quadMaterial(quad)));
    for (const int value : bucketAndDirection) byte(static_cast<shared::uint>(value));
}

void appendMesh(base::NpyArray& array, world::ChunkPos pos, mesh::ChunkMesh& mesh) {
    for (const mesh::MeshSection& meshSection : mesh.meshSections) {
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
                const mesh::QuadRange range = meshSection.ranges[bucket][direction];
                const auto quads = std::span(mesh.quads).subspan(range.first, range.count);
                // Each back end has an order of its own; files are the same.
                std::ranges::sort(quads, {}, [](shared::Quad q) { return std::pair(q.word0, q.word1); });
                for (const shared::Quad quad : quads) appendQuad(array.data, pos, quad, {bucket, direction});
            }
        }
    }
    array.shape[0] += mesh.quads.size();
}

base::NpyArray dumpQuads(const LoadedArea& area, const DumpOptions& options,
                         const world::BlockRegistry& blocks, mesh::BatchMesher& mesher) {
    std::vector<mesh::MeshInput> inputs;
    for (int y = 0; y < area.chunksY(); ++y) {
        for (int x = 0; x < area.chunksX(); ++x) {
            inputs.push_back(
                {&area.chunk(x, y),
                 {&area.chunk(x - 1, y), &area.chunk(x + 1, y), &area.chunk(x, y - 1), &area.chunk(x, y + 1)},
                 &blocks,
                 options.mesh});
        }
    }
    std::vector<mesh::ChunkMesh> meshes = mesher.mesh(inputs);
    base::NpyArray array{kQuadType, {0}, {}};
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const int x = static_cast<int>(k) % area.chunksX(), y = static_cast<int>(k) / area.chunksX();
        appendMesh(array, {options.area->x0 + x, options.area->y0 + y}, meshes[k]);
    }
    return array;
}

base::Result<void> dump(DumpOptions& options) {
    const world::ChunkArea area = *options.area;
    if (area.chunkCount() > kMaxChunksInFile) {
        return base::fail("--area: {} chunks, at most {} fit one file", area.chunkCount(), kMaxChunksInFile);
    }
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto save = openSave(options.world, options.save, store::WorldAccess::ReadOnly, *blocks);
    if (!save) return tl::unexpected(save.error());
    auto generator = makeGenerator(options.world, *blocks);
    if (!generator) return tl::unexpected(generator.error());
    const auto backendFor = [&](What what) { return options.what == what ? options.backend : Backend::Cpu; };
    const light::LightTable lights(*blocks);
    auto solver = makeLightSolver(backendFor(What::Light), lights);
    if (!solver) return tl::unexpected(solver.error());
    auto mesher = makeBatchMesher(backendFor(What::Quads), *blocks);
    if (!mesher) return tl::unexpected(mesher.error());
    base::JobSystem jobs(threadCount(options.world));
    LoadedArea loaded(area);
    if (auto done = loaded.load(save->get(), *generator, jobs); !done) return done;

    base::NpyArray array;
    switch (options.what) {
        case What::Blocks:
            array = dumpBlocks(loaded);
            break;
        case What::Light:
            array = dumpLight(loaded, *solver->worker);
            break;
        case What::Quads:
            array = dumpQuads(loaded, options, *blocks, *mesher->worker);
            break;
    }
    if (auto written = base::writeFile(options.output, base::encodeNpy(array)); !written) return written;
    base::logInfo("{}: {} chunks", options.output, area.chunkCount());
    return {};
}

std::vector<std::pair<std::string, mesh::MergeMethod>> mergeMethods() {
    std::vector<std::pair<std::string, mesh::MergeMethod>> methods;
    for (std::size_t k = 0; k < mesh::kMergeMethodNames.size(); ++k)
        methods.emplace_back(mesh::kMergeMethodNames[k], static_cast<mesh::MergeMethod>(k));
    return methods;
}

}  // namespace

CommandEntry addDump(CLI::App& app) {
    auto options = std::make_shared<DumpOptions>();
    CLI::App* command = app.add_subcommand("dump", "Write blocks, light or quads of an area as a NumPy file");
    addAreaOption(*command, options->area);
    command->get_option("--area")->required();
    addChoice<What>(*command, "--what", options->what,
                    {{"blocks", What::Blocks}, {"light", What::Light}, {"quads", What::Quads}},
                    "What to write");
    addBackendOption(*command, options->backend, "Where to find the light, or the quads");
    addChoice<mesh::MergeMethod>(*command, "--merging", options->mesh.method, mergeMethods(),
                                 "How equal faces are merged into rectangles");
    addChoice<int>(*command, "--mesh-section-height", options->mesh.meshSectionHeight,
                   {{"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}},
                   "Height in blocks of the mesh sections that quads are written by");
    addOutputOption(*command, options->output, "The .npy file");
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save, "World to take the chunks from; what it lacks is generated");
    return {command, [options] { return dump(*options); }};
}

}  // namespace terrane::app
