// terrane check: checks a save for damage.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/text.h"
#include "terrane/io/open_session.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::app {
namespace {

struct CheckOptions {
    std::string file;
    bool json = false;
    bool foundDamage = false;  // result of the run
};

nlohmann::json toJson(const store::CheckReport& report) {
    nlohmann::json damaged = nlohmann::json::array();
    for (const store::DamagedChunk& chunk : report.damaged)
        damaged.push_back(
            {{"x", chunk.pos.x}, {"y", chunk.pos.y}, {"level", chunk.pos.level}, {"problem", chunk.problem}});
    return {{"damaged", report.isDamaged()},
            {"in_use", !report.inUse.empty()},
            {"format", report.format},
            {"seed", report.identity.seed},
            {"generator", report.identity.generator},
            {"generator_version", report.identity.generatorVersion},
            {"bottom", report.identity.heights.bottom},
            {"top", report.identity.heights.top},
            {"chunks", report.chunks},
            {"edited_chunks", report.editedChunks},
            {"tiles", report.tiles},
            {"chunk_bytes", report.chunkBytes},
            {"file_bytes", report.fileBytes},
            {"quarantined", report.quarantined},
            {"unknown_blocks", report.unknownBlocks},
            {"file_problems", report.fileProblems},
            {"damaged_chunks", std::move(damaged)},
            {"unlisted", report.unlisted}};
}

void printText(const std::string& file, const store::CheckReport& report) {
    if (!report.inUse.empty())
        base::printLine("{}: read as of one moment, without its log; nothing is changed", report.inUse);
    if (report.format > 0) {
        base::printLine("{}: format {}, generator {} version {}, seed {}", file, report.format,
                        report.identity.generator, report.identity.generatorVersion, report.identity.seed);
        base::printLine("{} chunks, {} of them edited, {} of them tiles; {} bytes; the file has {} bytes",
                        report.chunks, report.editedChunks, report.tiles, report.chunkBytes,
                        report.fileBytes);
    }
    if (report.quarantined > 0) base::printLine("{} damaged chunks are in quarantine", report.quarantined);
    for (const std::string& name : report.unknownBlocks) base::printLine("unknown block: {}", name);
    for (const std::string& problem : report.fileProblems) base::printLine("damage: {}", problem);
    for (const store::DamagedChunk& chunk : report.damaged)
        base::printLine("damage: {}: {}", store::nameOf(chunk.pos), chunk.problem);
    if (report.unlisted > 0) base::printLine("damage: {} more chunks", report.unlisted);
    base::printLine("{}", report.isDamaged() ? "damaged" : "good");
}

base::Result<void> check(CheckOptions& options) {
    const auto content = TERRANE_TRY(io::loadContent({}, {.world = options.file, .storeGenerated = {}}));
    const auto report =
        TERRANE_TRY(store_postgres::checkAnyWorld(store::worldLocation(options.file), *content.blocks));
    options.foundDamage = report.isDamaged();
    if (options.json) {
        // SQLite's messages about broken pages and names of blocks may be invalid UTF-8; everything but ASCII
        // is escaped.
        std::cout << toJson(report).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
    } else {
        printText(store_postgres::shownOf(store::worldLocation(options.file)), report);
    }
    return {};
}

}  // namespace

CommandEntry addCheck(CLI::App& app) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* command = app.add_subcommand("check", "Check a world for damage; exit code 1 if there is any");
    command->add_option("file", options->file, "The world")->type_name("NAME|FILE|URL")->required();
    command->add_flag("--json", options->json, "Print the report as JSON");
    return {command, [options] { return check(*options); },
            [options] { return options->foundDamage ? 1 : 0; }};
}

}  // namespace terrane::app
