#include "apps/terrane/formats/import_world.h"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "apps/terrane/open_session.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/stream/edited_tiles.h"

namespace terrane::app {

namespace {

constexpr std::size_t kKeptDamage = 1000, kLoggedDamage = 5, kLoggedNames = 5;

std::uint64_t sumOf(const std::map<std::string, std::uint64_t>& counts) {
    std::uint64_t sum = 0;
    for (const auto& [name, count] : counts) sum += count;
    return sum;
}

// "minecraft:a (12), minecraft:b (3) and 4 more": the most frequent first.
std::string mostOf(const std::map<std::string, std::uint64_t>& counts) {
    std::vector<std::pair<std::string, std::uint64_t>> sorted(counts.begin(), counts.end());
    std::ranges::stable_sort(sorted, std::ranges::greater(), [](const auto& entry) { return entry.second; });
    std::string text;
    for (std::size_t k = 0; k < std::min(kLoggedNames, sorted.size()); ++k)
        text += fmt::format("{}{} ({})", k > 0 ? ", " : "", sorted[k].first, sorted[k].second);
    if (sorted.size() > kLoggedNames) text += fmt::format(" and {} more", sorted.size() - kLoggedNames);
    return text;
}

// A hostile file may have any number of names: at most 65,536 of up to 200 bytes are counted one by one.
void addCounts(std::map<std::string, std::uint64_t>& sum, const std::map<std::string, std::uint64_t>& more) {
    constexpr std::size_t kToldApart = 65536, kNameBytes = 200;
    for (const auto& [name, count] : more) {
        const std::string shortName = name.substr(0, kNameBytes);
        const bool isFull = sum.size() >= kToldApart && !sum.contains(shortName);
        sum[isFull ? "(others)" : shortName] += count;
    }
}

}  // namespace

void addTo(formats::ImportCounts& sum, const formats::ImportCounts& more) {
    addCounts(sum.blocks, more.blocks);
    addCounts(sum.unknown, more.unknown);
    addCounts(sum.blockEntities, more.blockEntities);
    sum.below += more.below;
    sum.above += more.above;
}

void noteDamage(ImportReport& report, std::string line) {
    if (report.damageCount < kLoggedDamage) base::logWarning("{}; left out", line);
    if (++report.damageCount <= kKeptDamage) report.damaged.push_back(std::move(line));
}

void logReport(const ImportReport& report) {
    const formats::ImportCounts& counts = report.counts;
    base::logInfo("{} chunks with {} blocks imported; {} had edits in the world and stay as they are",
                  report.chunks, sumOf(counts.blocks), report.skipped);
    if (report.unfinished > 0)
        base::logInfo("{} of the chunks are not completely generated in the source", report.unfinished);
    if (report.damageCount > 0) base::logWarning("{} chunks or files could not be read", report.damageCount);
    if (!counts.unknown.empty())
        base::logWarning("{} blocks are unknown and became \"missing\": {}", sumOf(counts.unknown),
                         mostOf(counts.unknown));
    if (counts.below + counts.above > 0)
        base::logWarning("{} blocks below and {} above the world's heights are left out (see --shift)",
                         counts.below, counts.above);
    if (!counts.blockEntities.empty())
        base::logInfo("contents of {} blocks are left out: {}", sumOf(counts.blockEntities),
                      mostOf(counts.blockEntities));
}

std::string jsonOf(const ImportReport& report) {
    const formats::ImportCounts& counts = report.counts;
    const nlohmann::json json = {{"chunks", report.chunks},         {"skipped", report.skipped},
                                 {"unfinished", report.unfinished}, {"damage_count", report.damageCount},
                                 {"damaged", report.damaged},       {"blocks", counts.blocks},
                                 {"unknown", counts.unknown},       {"block_entities", counts.blockEntities},
                                 {"below", counts.below},           {"above", counts.above}};
    // Names come from the file and may be invalid UTF-8.
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

base::Result<void> writeReport(const ImportReport& report, const std::string& file) {
    return base::writeFile(file, jsonOf(report));
}

base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content) {
    if (options.save.world.empty())
        return base::fail(base::ErrorCode::BadInput, "import needs --world NAME|FILE|URL");
    ImportWorld world;
    world.content = std::move(content);
    auto store =
        TERRANE_TRY(openSave(options.world, options.save, store::WorldAccess::ReadWrite, world.content));
    auto generators =
        TERRANE_TRY(gen::makeLevelGenerators(options.world.effectiveGenerator(), *world.content.blocks,
                                             options.world.effectiveSeed(), world.content.generators));
    world.generators = std::make_unique<gen::LevelGenerators>(std::move(generators));
    world.store = std::move(store);
    stream::maintainTileRows(*world.store, *world.generators, *world.content.blocks, {});
    return world;
}

}  // namespace terrane::app
