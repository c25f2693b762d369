// A second program on the library: it does much of what the program terrane does with worlds, each in a few
// lines.
//
//     world_tools FOLDER [postgresql://HOST/DATABASE]
//
// Makes a world in the folder, which must be empty, puts a model of MagicaVoxel into it, writes it as files
// of other programs and as a map, serves it to a simulated player and records a video of it. With a database,
// generates an area there.
#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/content/resource_pack.h"
#include "terrane/formats/vox_file.h"
#include "terrane/io/area_files.h"
#include "terrane/io/export_formats.h"
#include "terrane/io/loaded_square.h"
#include "terrane/io/map_world.h"
#include "terrane/io/open_session.h"
#include "terrane/io/volume_import.h"
#include "terrane/net/client/bot.h"
#include "terrane/net/server/server_loop.h"
#include "terrane/net/server/server_statistics.h"
#include "terrane/net_postgres/world_records.h"
#include "terrane/store_postgres/worker.h"
#include "terrane/video/frame_sink.h"
#include "terrane/view/recorder.h"
#include "terrane/web/server_map.h"
#include "terrane/web/static_map.h"

namespace {

using namespace terrane;
namespace fs = std::filesystem;

constexpr world::ChunkArea kArea{0, 0, 1, 1};
constexpr world::BlockPos kModelAt{4, 4, 81};  // the generator `flat` has ground up to 80

io::WorldOptions flatLand() {
    io::WorldOptions options;
    options.generator = "flat";
    options.threads = 2;
    return options;
}

io::SaveOptions worldIn(const fs::path& folder) {
    return {.world = (folder / "world.sqlite").string(), .storeGenerated = {}};
}

base::Result<void> importModel(const fs::path& folder) {
    formats::VoxImage model{.size = {8, 8, 8}, .colors = {}, .cells = std::vector<std::uint8_t>(512, 1)};
    model.colors[1] = 0x808080FF;
    TERRANE_TRY(base::writeFile(folder / "cube.vox", formats::encodeVox(model)));
    io::ImportOptions options{folder / "cube.vox", flatLand(), worldIn(folder), ""};
    const auto report =
        TERRANE_TRY(io::importVolume(options, {io::VolumeFormat::Vox, kModelAt, /*skipsAir=*/true}));
    std::printf("import: %d chunk\n", static_cast<int>(report.chunks));
    return {};
}

base::Result<void> exportArea(const fs::path& folder) {
    io::ExportOptions options{flatLand(), worldIn(folder), kArea, ""};
    const auto source = TERRANE_TRY(io::openExport(options));
    const auto mesh = TERRANE_TRY(io::exportGlb(source, folder / "area.glb"));
    const auto heights = TERRANE_TRY(io::exportNpyHeights(source, folder / "heights.npy"));
    std::printf("export: %s; %s\n", mesh.content.c_str(), heights.content.c_str());

    // Blocks of an area of any size as a NumPy array, square by square.
    base::JobSystem jobs(source.threads);
    auto file = TERRANE_TRY(io::VolumeFile::create(folder / "blocks.npy", kArea, source.generator.heights()));
    for (std::int64_t k = 0; k < io::squareCount(kArea); ++k) {
        io::LoadedSquare square(io::squareOf(kArea, k));
        TERRANE_TRY(square.load(source.save.get(), source.generator, jobs));
        TERRANE_TRY(file.write(square.area(), [&](int x, int y, auto values) {
            const world::Chunk& chunk = square.chunk(x / world::kChunkSize, y / world::kChunkSize);
            for (int z = chunk.heights().bottom; std::uint16_t & value : values)
                value = chunk.block(world::blockIndex(x & 15, y & 15, z++));
        }));
    }
    return file.finish();
}

base::Result<void> writeMap(const fs::path& folder) {
    io::WorldOptions options = flatLand();
    const auto world = TERRANE_TRY(io::openMapWorld(options, worldIn(folder), ""));
    auto painter = TERRANE_TRY(io::painterOf(*world));
    auto layers = TERRANE_TRY(web::layersOf({"day"}, painter));
    const web::StaticMapSettings settings{
        .folder = folder / "map", .area = kArea, .layers = std::move(layers), .places = {}};
    const auto map = TERRANE_TRY(web::writeStaticMap(*world, painter, settings));
    std::printf("map: %d of %d images written\n", static_cast<int>(map.written),
                static_cast<int>(map.images));
    return {};
}

// A server, its map for browsers and one player, all on this thread. Ends when the server has stored a block
// that the player placed.
base::Result<void> serve(const fs::path& folder) {
    using Clock = std::chrono::steady_clock;
    io::WorldOptions options = flatLand();
    auto opened = TERRANE_TRY(io::openSessionParts(options, worldIn(folder), store::WorldAccess::ReadWrite,
                                                   store::WorldSharing::Servers));
    const auto content = TERRANE_TRY(net::serverContent(opened.content));
    auto records = TERRANE_TRY(
        net_postgres::openRecords(store::worldLocation(worldIn(folder).world), *opened.parts.blocks));
    const auto host = TERRANE_TRY(
        net::openServerHost(std::move(opened.parts), std::move(records.records), {}, "world_tools", content));
    boost::asio::io_context context;
    const auto sockets =
        TERRANE_TRY(net::ServerSockets::open(context, *host.state, {"127.0.0.1", 0}, folder / "server.pem"));
    auto statistics = TERRANE_TRY(net::ServerStatistics::open((folder / "statistics.jsonl").string()));
    const auto map = TERRANE_TRY(
        web::ServerMap::open(context, *host.state, {}, web::ShownPlayers::All, opened.content.textures));

    net::BotSettings settings;
    settings.servers = {{"127.0.0.1", sockets->port()}};
    settings.program = "world_tools";
    settings.behaviour = net::BotBehaviour::Build;
    settings.editsPerSecond = 10;
    net::BotWorld players({.cache = {}, .acceptsAll = true, .accepted = {}, .packs = {}, .missing = {}});
    const auto key = TERRANE_TRY(net::botKey(settings, 0));
    net::Bot player(context, players, settings, 0, key);

    const Clock::time_point end = Clock::now() + std::chrono::seconds(60);
    net::ServerLoop loop;
    loop.stopRequested = [&] { return !players.decidedMs.empty() || Clock::now() > end; };
    loop.onTick = [&](double milliseconds) {
        statistics.addTick(net::countsOf(*host.state), milliseconds);
        map->tick(milliseconds);
        player.update(Clock::now());
    };
    TERRANE_TRY(net::runServer(context, *host.state, *sockets, loop));
    std::printf("server: %d player joined, %s\n", static_cast<int>(players.joins),
                players.decidedMs.empty() ? "and built nothing" : "and built");
    return {};
}

base::Result<void> record(const fs::path& folder) {
    io::WorldOptions options = flatLand();
    auto opened = TERRANE_TRY(io::openSessionParts(options, worldIn(folder), store::WorldAccess::ReadOnly));
    const auto textures =
        TERRANE_TRY(content::loadTextures("", *opened.parts.blocks, opened.content.textures));
    view::OffscreenSettings settings{.size = {320, 180}, .graphics = {"low", {}, 2}};
    auto world = TERRANE_TRY(
        view::Offscreen::create(std::move(opened.parts), opened.content.generators, textures, settings));
    view::CameraKey from, to;
    from.position = {-8, -8, 92};
    to.position = {24, -8, 92};
    to.time = 1;
    from.lookAt = to.lookAt = glm::dvec3(8, 8, 85);
    const std::vector<view::Shot> shots{{.name = "around the cube",
                                         .seconds = 1,
                                         .path = view::CameraPath({from, to}),
                                         .options = {{0, settings.graphics, render::View::Color}},
                                         .titles = {},
                                         .edits = {},
                                         .players = {}}};
    view::Recorder recorder({shots, *world, settings.size, {}});
    const auto frames = TERRANE_TRY(video::openFrameFolder((folder / "frames").string()));
    for (const double seconds : {0.0, 0.5, 1.0}) {
        const auto image = TERRANE_TRY(recorder.frame(seconds));
        TERRANE_TRY(frames->add(image));
    }
    TERRANE_TRY(world->finish());
    TERRANE_TRY(frames->finish());
    std::printf("video: 3 frames\n");
    return {};
}

base::Result<void> generateIn(const std::string& database) {
    using store_postgres::Connection;
    const auto address = TERRANE_TRY(store_postgres::addressOf(database));
    store_postgres::ConnectionPool pool(address);
    io::WorldOptions options = flatLand();
    const io::SaveOptions save{.world = database, .storeGenerated = {}};
    const auto content = TERRANE_TRY(io::loadContent(options, save));
    const auto store = TERRANE_TRY(
        io::openSave(options, save, store::WorldAccess::ReadWrite, content, store::WorldSharing::Generating));
    (void)TERRANE_TRY(pool.run<bool>([](Connection& connection) {
        return store_postgres::addArea(connection, kArea, store_postgres::JobOrder::Spiral);
    }));
    auto generator = TERRANE_TRY(io::makeGenerator(options, content));
    const auto batches = gen::makeCpuGenerator(std::move(generator), options.threads);
    const auto made = TERRANE_TRY(
        store_postgres::work({*batches, *store, pool, "world_tools", false, [] { return false; }}));
    std::printf("database: %d chunks generated\n", static_cast<int>(made.chunks));
    return {};
}

base::Result<void> useEachOnce(const fs::path& folder, const std::string& database) {
    TERRANE_TRY(importModel(folder));
    TERRANE_TRY(exportArea(folder));
    TERRANE_TRY(writeMap(folder));
    TERRANE_TRY(serve(folder));
    TERRANE_TRY(record(folder));
    return database.empty() ? base::Result<void>() : generateIn(database);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3)
        return std::fprintf(stderr, "usage: world_tools FOLDER [postgresql://HOST/DATABASE]\n"), 1;
    std::error_code error;
    fs::create_directories(argv[1], error);  // an error shows at the first file
    const auto done = useEachOnce(argv[1], argc == 3 ? argv[2] : "");
    if (!done) return std::fprintf(stderr, "%s\n", done.error().message.c_str()), 1;
}
