#include "terrane/io/import_world.h"

#include "terrane/base/log.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/io/open_session.h"
#include "terrane/stream/edited_tiles.h"

namespace terrane::io {

namespace {

constexpr std::size_t kKeptDamage = 1000, kLoggedDamage = 5;

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

base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content) {
    if (options.save.world.empty())
        return base::fail(base::ErrorCode::BadInput, "an import needs a world to write into");
    ImportWorld world;
    world.content = std::move(content);
    auto store =
        TERRANE_TRY(openSave(options.world, options.save, store::WorldAccess::ReadWrite, world.content));
    auto generators = TERRANE_TRY(gen::makeLevelGenerators(
        options.world.effectiveGenerator(), *world.content.blocks, options.world.effectiveSeed(),
        world.content.generators, store->identity().heights));
    world.generators = std::make_unique<gen::LevelGenerators>(std::move(generators));
    world.store = std::move(store);
    world.threads = threadCount(options.world);
    stream::maintainTileRows(*world.store, *world.generators, *world.content.blocks, {});
    return world;
}

}  // namespace terrane::io
