// terrane dump: writes blocks, light or quads of an area as a NumPy file, for checks by other programs.
#include <functional>
#include <memory>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/io/area_files.h"
#include "terrane/io/loaded_square.h"
#include "terrane/io/open_session.h"

namespace terrane::app {
namespace {

enum class What { Blocks, Light, Quads };

struct DumpOptions {
    io::WorldOptions world;
    std::optional<world::ChunkArea> area;
    What what = What::Blocks;
    std::string output;
    io::SaveOptions save;
    Backend backend = Backend::Auto;
    mesh::MeshOptions mesh;
};

// Sources of chunks, and the signals that stop the dump.
struct Sources {
    std::shared_ptr<const world::BlockRegistry> blocks;
    std::unique_ptr<store::ChunkStore> save;  // may be null
    gen::Generator generator;
    const base::StopSignals& signals;
};

base::Result<Sources> openSources(DumpOptions& options, const base::StopSignals& signals) {
    const auto content = TERRANE_TRY(io::loadContent(options.world, options.save));
    auto save = TERRANE_TRY(io::openSave(options.world, options.save, store::WorldAccess::ReadOnly, content));
    auto generator = TERRANE_TRY(io::makeGenerator(options.world, content));
    return Sources{content.blocks, std::move(save), std::move(generator), signals};
}

// Calls `take` for each loaded square until it fails or a signal stops the program.
base::Result<void> forEachSquare(const DumpOptions& options, const Sources& sources,
                                 const std::function<base::Result<void>(const io::LoadedSquare&)>& take) {
    const world::ChunkArea& area = *options.area;
    base::JobSystem jobs(io::threadCount(options.world));
    base::ProgressBar bar("dumping", static_cast<std::size_t>(area.chunkCount()));
    std::int64_t done = 0;
    for (std::int64_t k = 0; k < io::squareCount(area); ++k) {
        io::LoadedSquare square(io::squareOf(area, k));
        TERRANE_TRY(square.load(sources.save.get(), sources.generator, jobs));
        TERRANE_TRY(take(square));
        done += square.area().chunkCount();
        bar.set(static_cast<std::size_t>(done));
        if (sources.signals.stopRequested())
            return base::fail("stopped after {} of {} chunks", done, area.chunkCount());
    }
    return {};
}

// The values of a column of a chunk or of its light, upward. `sectionOf`: section or brick by number.
template <class SectionOf>
void copyColumn(world::Heights heights, int x, int y, const SectionOf& sectionOf,
                std::span<std::uint16_t> values) {
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        const world::Section& section = sectionOf(number);
        const auto part = values.subspan(
            static_cast<std::size_t>(number * world::kSectionSize - heights.bottom), world::kSectionSize);
        if (section.isUniform()) {
            std::ranges::fill(part, section.uniformValue());
            continue;
        }
        for (int z = 0; z < world::kSectionSize; ++z)
            part[static_cast<std::size_t>(z)] = section.get(world::blockIndex(x & 15, y & 15, z));
    }
}

base::Result<void> dumpBlocks(const DumpOptions& options, const Sources& sources) {
    auto file =
        TERRANE_TRY(io::VolumeFile::create(options.output, *options.area, options.world.heights.over({})));
    const auto written = forEachSquare(options, sources, [&](const io::LoadedSquare& square) {
        return file.write(square.area(), [&](int x, int y, auto values) {
            const world::Chunk& chunk = square.chunk(x / world::kChunkSize, y / world::kChunkSize);
            const auto section = [&](int number) -> const world::Section& { return chunk.section(number); };
            copyColumn(chunk.heights(), x, y, section, values);
        });
    });
    return written ? file.finish() : written;
}

// The light of a square and of a border of one chunk, which ends at the end of the world: beyond it is dark.
struct SquareLight {
    int west = 0, south = 0;  // chunks before the square's first one
    int width = 0;            // chunks
    std::vector<light::ChunkLight> chunks;

    const light::ChunkLight& chunk(int x, int y) const {
        return chunks[static_cast<std::size_t>(x + west + width * (y + south))];
    }
};

SquareLight lightOf(const io::LoadedSquare& square, light::AreaSolver& solver) {
    const world::ChunkArea& area = square.area();
    const int west = area.x0 > world::kMinChunk ? 1 : 0, east = area.x1 <= world::kMaxChunk ? 1 : 0;
    const int south = area.y0 > world::kMinChunk ? 1 : 0, north = area.y1 <= world::kMaxChunk ? 1 : 0;
    light::LightArea around{west + square.chunksX() + east, south + square.chunksY() + north, {}};
    for (int y = -south; y < square.chunksY() + north; ++y)
        for (int x = -west; x < square.chunksX() + east; ++x) around.chunks.push_back(&square.chunk(x, y));
    return {west, south, around.chunksX, solver.solve(around)};
}

base::Result<void> dumpLight(const DumpOptions& options, const Sources& sources) {
    const light::LightTable table(*sources.blocks);
    const auto solver = TERRANE_TRY(makeLightSolver(options.backend, table));
    auto file =
        TERRANE_TRY(io::VolumeFile::create(options.output, *options.area, options.world.heights.over({})));
    const auto written = forEachSquare(options, sources, [&](const io::LoadedSquare& square) {
        const SquareLight lights = lightOf(square, *solver.worker);
        return file.write(square.area(), [&](int x, int y, auto values) {
            const light::ChunkLight& light = lights.chunk(x / world::kChunkSize, y / world::kChunkSize);
            const auto brick = [&](int number) -> const world::Section& { return light.brick(number); };
            copyColumn(light.heights(), x, y, brick, values);
        });
    });
    return written ? file.finish() : written;
}

base::Result<void> appendQuads(io::QuadFile& file, const io::LoadedSquare& square, mesh::BatchMesher& mesher,
                               const mesh::MeshOptions& options, const world::BlockRegistry& blocks) {
    std::vector<mesh::MeshInput> inputs;
    for (int y = 0; y < square.chunksY(); ++y) {
        for (int x = 0; x < square.chunksX(); ++x) {
            inputs.push_back({&square.chunk(x, y),
                              {&square.chunk(x - 1, y), &square.chunk(x + 1, y), &square.chunk(x, y - 1),
                               &square.chunk(x, y + 1)},
                              &blocks,
                              options});
        }
    }
    std::vector<mesh::ChunkMesh> meshes = mesher.mesh(inputs);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const int x = static_cast<int>(k) % square.chunksX(), y = static_cast<int>(k) / square.chunksX();
        const world::ChunkPos pos{square.area().x0 + x, square.area().y0 + y};
        TERRANE_TRY(file.append(pos, meshes[k]));
    }
    return {};
}

base::Result<void> dumpQuads(const DumpOptions& options, const Sources& sources) {
    const auto mesher = TERRANE_TRY(makeBatchMesher(options.backend, *sources.blocks));
    auto file = TERRANE_TRY(io::QuadFile::create(options.output, options.world.heights.over({})));
    const auto written = forEachSquare(options, sources, [&](const io::LoadedSquare& square) {
        return appendQuads(file, square, *mesher.worker, options.mesh, *sources.blocks);
    });
    return written ? file.finish() : written;
}

base::Result<void> dump(DumpOptions& options) {
    const base::StopSignals signals;  // the writer removes an unfinished file
    const auto sources = TERRANE_TRY(openSources(options, signals));
    TERRANE_TRY(options.what == What::Blocks  ? dumpBlocks(options, sources)
                : options.what == What::Light ? dumpLight(options, sources)
                                              : dumpQuads(options, sources));
    base::logInfo("{}: {} chunks", options.output, options.area->chunkCount());
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
    addBackendOption(*command, options->backend, "Device that computes light or quads");
    addChoice<mesh::MergeMethod>(*command, "--merging", options->mesh.method, mergeMethods(),
                                 "Method that merges equal faces into quads");
    addChoice<int>(*command, "--mesh-section-height", options->mesh.meshSectionHeight,
                   {{"8", 8}, {"16", 16}, {"32", 32}, {"64", 64}, {"128", 128}},
                   "Height in blocks of the mesh sections that quads are written by");
    addOutputOption(*command, options->output, {".npy"}, "The .npy file");
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save, "World to read; missing chunks are generated");
    return {command, [options] { return dump(*options); }};
}

}  // namespace terrane::app
