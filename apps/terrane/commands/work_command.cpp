// terrane work: generates areas of a world in a database, on any number of machines.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/process.h"
#include "terrane/base/text.h"
#include "terrane/io/open_session.h"
#include "terrane/store_postgres/postgres_store.h"
#include "terrane/store_postgres/worker.h"

namespace terrane::app {
namespace {

using store_postgres::Connection;
using store_postgres::JobOrder;
using store_postgres::WorkStatus;

struct WorkOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    AreaOptions chunks;
    JobOrder order = JobOrder::Spiral;
    Backend backend = Backend::Auto;
    bool addsOnly = false, waits = false, status = false, pause = false, goOn = false, cancel = false,
         json = false;
};

nlohmann::json toJson(const WorkStatus& status) {
    nlohmann::json workers = nlohmann::json::array();
    for (const store_postgres::WorkerStatus& worker : status.workers) {
        nlohmann::json line = {{"name", worker.name},
                               {"chunks", worker.chunks},
                               {"chunks_per_second", worker.rate},
                               {"silent_seconds", worker.silentSeconds}};
        if (worker.area) line["area"] = {worker.area->x0, worker.area->y0, worker.area->x1, worker.area->y1};
        workers.push_back(std::move(line));
    }
    return {{"paused", status.isPaused},
            {"jobs",
             {{"waiting", status.waiting},
              {"working", status.working},
              {"done", status.done},
              {"cancelled", status.cancelled}}},
            {"chunks", status.chunks},
            {"chunks_done", status.chunksDone},
            {"chunks_per_second", status.rate},
            {"workers", std::move(workers)}};
}

void print(const WorkStatus& status) {
    base::printLine("{} of {} chunks done; squares: {} waiting, {} worked on, {} done, {} cancelled{}",
                    status.chunksDone, status.chunks, status.waiting, status.working, status.done,
                    status.cancelled, status.isPaused ? "; paused" : "");
    if (status.rate > 0)
        base::printLine("{:.0f} chunks/s, about {:.0f} s left", status.rate,
                        static_cast<double>(status.chunks - status.chunksDone) / status.rate);
    for (const store_postgres::WorkerStatus& worker : status.workers) {
        const std::string at = worker.area ? fmt::format("at chunk {},{}", worker.area->x0, worker.area->y0)
                                           : "without a square";
        base::printLine("{}: {} chunks, {:.0f} chunks/s, {}, last seen {:.0f} s ago", worker.name,
                        worker.chunks, worker.rate, at, worker.silentSeconds);
    }
}

base::Result<void> printStatus(store_postgres::ConnectionPool& pool, bool asJson) {
    const auto status =
        TERRANE_TRY(pool.run<WorkStatus>([](Connection& connection) { return workStatus(connection); }));
    if (asJson)
        std::cout << toJson(status).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
    else
        print(status);
    return {};
}

base::Result<void> addArea(store_postgres::ConnectionPool& pool, const WorkOptions& options) {
    const auto area = areaOf(options.chunks);
    if (!area) return {};
    const auto added = TERRANE_TRY(pool.run<bool>(
        [&](Connection& connection) { return store_postgres::addArea(connection, *area, options.order); }));
    if (!added)
        base::logInfo("the area {},{} to {},{} was added before", area->x0, area->y0, area->x1, area->y1);
    return {};
}

base::Result<void> runWorker(WorkOptions& options, store_postgres::ConnectionPool& pool,
                             store::ChunkStore& store, const pack::Content& content) {
    auto generator = TERRANE_TRY(makeBatchGenerator(options.world, options.backend, content));
    const base::StopSignals signals;
    const auto start = std::chrono::steady_clock::now();
    const auto result = TERRANE_TRY(store_postgres::work(
        {*generator.worker, store, pool, base::processName(), options.waits,
         [&] { return signals.stopRequested(); },
         [] { base::logInfo("the work is paused: `terrane work URL --continue` lets it go on"); }}));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double rate = static_cast<double>(result.chunks) / std::max(seconds, 1e-3);
    if (options.json) {
        const nlohmann::json line = {{"jobs", result.jobs},
                                     {"chunks", result.chunks},
                                     {"skipped", result.skipped},
                                     {"seconds", seconds},
                                     {"chunks_per_second", rate},
                                     {"threads", io::threadCount(options.world)},
                                     {"backend", generator.worker->backend()}};
        std::cout << line.dump() << '\n';
        return {};
    }
    base::printLine("{} squares, {} chunks generated and {} already there, in {:.1f} s, {:.0f} chunks/s",
                    result.jobs, result.chunks, result.skipped, seconds, rate);
    return {};
}

bool onlyManages(const WorkOptions& options) {
    return options.pause || options.goOn || options.cancel || options.status;
}

base::Result<void> manage(const WorkOptions& options, store_postgres::ConnectionPool& pool) {
    if (options.pause || options.goOn) {
        TERRANE_TRY(
            pool.run<void>([&](Connection& connection) { return setPaused(connection, options.pause); }));
    }
    if (options.cancel) {
        const auto count = TERRANE_TRY(
            pool.run<std::int64_t>([](Connection& connection) { return cancelJobs(connection); }));
        base::logInfo("{} squares cancelled", count);
    }
    return options.status ? printStatus(pool, options.json) : base::Result<void>();
}

base::Result<void> runWork(WorkOptions& options) {
    if (!store_postgres::isPostgresUrl(options.save.world))
        return base::fail(
            base::ErrorCode::BadInput,
            "work: the world is not in PostgreSQL (postgresql://host/database); `terrane generate` makes "
            "an area of a file");
    const auto address = TERRANE_TRY(store_postgres::addressOf(options.save.world));
    store_postgres::ConnectionPool pool(address);
    const auto content = TERRANE_TRY(io::loadContent(options.world, options.save));
    if (onlyManages(options)) {
        // Fails if the database holds no world.
        (void)TERRANE_TRY(store_postgres::openRowsToRead(address, *content.blocks));
        return manage(options, pool);
    }
    auto store = TERRANE_TRY(io::openSave(options.world, options.save, store::WorldAccess::ReadWrite, content,
                                          store::WorldSharing::Generating));
    if (auto added = addArea(pool, options); !added || options.addsOnly) return added;
    return runWorker(options, pool, *store, content);
}

}  // namespace

CommandEntry addWork(CLI::App& app) {
    auto options = std::make_shared<WorkOptions>();
    CLI::App* command = app.add_subcommand(
        "work", "Generate areas of a world in a database, with any number of machines at once");
    addWorldArgument(*command, "world", options->save.world, "The world; created if needed");
    addAreaOptions(*command, options->chunks, 16000,
                   "Add (2R+1)² chunks around 0,0 to the queue. All workers may have this option");
    addChoice<JobOrder>(*command, "--order", options->order,
                        {{"spiral", JobOrder::Spiral}, {"rows", JobOrder::Rows}},
                        "Order in which squares of 32×32 chunks are generated");
    command->add_flag("--add-only", options->addsOnly, "Add to the queue and end");
    command->add_flag("--wait", options->waits, "Wait for more work when the queue is empty");
    command->add_flag("--status", options->status, "Print the progress and all workers");
    CLI::Option* pause =
        command->add_flag("--pause", options->pause, "Stop workers from taking squares until --continue");
    command->add_flag("--continue", options->goOn, "Continue after --pause")->excludes(pause);
    command->add_flag("--cancel", options->cancel, "Remove all squares that are not done from the queue");
    command->add_flag("--json", options->json, "Print the result, or the status, as JSON");
    addBackendOption(*command, options->backend, "Device that generates");
    addWorldOptions(*command, options->world);
    return {command, [options] { return runWork(*options); }};
}

}  // namespace terrane::app
