#include "terrane/io/minecraft_import.h"

#include <algorithm>
#include <fstream>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/base/job_system.h"
#include "terrane/base/log.h"
#include "terrane/formats/file_kind.h"
#include "terrane/io/import_world.h"
#include "terrane/io/open_session.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::io {

namespace {

namespace fs = std::filesystem;

// Limit on a folder: 2^20 regions of 512² blocks, 1,024 × 1,024 of them, are 524,288 blocks a side.
constexpr std::size_t kMaxRegions = std::size_t{1} << 20;

bool isFolder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

// Folders in a world's folder that may hold the dimension's regions, the newest layout first: that of 26.1,
// then that of 1.2 to 1.21. The last of the overworld is the named folder itself.
std::vector<fs::path> regionFolders(const std::string& dimension) {
    const fs::path own = fs::path("dimensions") / "minecraft";
    if (dimension == "nether") return {own / "the_nether" / "region", "DIM-1/region"};
    if (dimension == "end") return {own / "the_end" / "region", "DIM1/region"};
    return {own / "overworld" / "region", "region", "."};
}

base::Result<std::vector<RegionSource>> regionsIn(const fs::path& folder) {
    std::vector<RegionSource> regions;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const auto pos = formats::regionPosOf(it->path().filename().string());
        if (!pos) continue;
        if (regions.size() == kMaxRegions)
            return base::fail("{}: more than {} region files", folder.string(), kMaxRegions);
        regions.push_back({it->path(), *pos});
    }
    if (error)
        return base::fail(base::ErrorCode::Io, "{}: cannot be read: {}", folder.string(), error.message());
    std::ranges::sort(regions, {},
                      [](const RegionSource& region) { return std::tuple(region.pos.z, region.pos.x); });
    return regions;
}

// The table of a region's chunks; nothing if the file cannot be read.
std::optional<std::string> regionHeader(const fs::path& path) {
    constexpr std::size_t kHeaderBytes = std::size_t{4} * formats::kRegionChunks;
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    std::string header(kHeaderBytes, '\0');
    file.read(header.data(), static_cast<std::streamsize>(header.size()));
    if (file.bad()) return std::nullopt;
    return header;
}

bool isInArea(formats::RegionPos region, int number, const std::optional<world::ChunkArea>& area) {
    if (!area) return true;
    const auto [x, z] = chunkOfRegion(region, number);
    return x >= area->x0 && x < area->x1 && z >= area->y0 && z < area->y1;
}

// Leaves the regions that have chunks in the area, and those that cannot be read: the import reports them.
void keepRegionsWithChunks(std::vector<RegionSource>& regions, const std::optional<world::ChunkArea>& area) {
    std::erase_if(regions, [&](const RegionSource& region) {
        const auto header = regionHeader(region.path);
        for (int number = 0; header && number < formats::kRegionChunks; ++number)
            if (formats::regionHasChunk(*header, number) && isInArea(region.pos, number, area)) return false;
        return header.has_value();
    });
}

// The regions of each layout that has chunks, the newest first.
base::Result<std::vector<std::vector<RegionSource>>> layoutsOf(const fs::path& source,
                                                               const std::string& dimension) {
    std::vector<std::vector<RegionSource>> layouts;
    for (const fs::path& name : regionFolders(dimension)) {
        const fs::path folder = name == "." ? source : source / name;
        if (!isFolder(folder)) continue;
        auto regions = TERRANE_TRY(regionsIn(folder));
        keepRegionsWithChunks(regions, std::nullopt);
        if (!regions.empty()) layouts.push_back(std::move(regions));
    }
    return layouts;
}

base::Error noRegions(const fs::path& source, const std::string& dimension) {
    std::vector<std::string> names;
    for (const fs::path& name : regionFolders(dimension))
        names.push_back(name == "." ? "the folder itself" : name.string());
    std::string others;
    for (const char* other : {"overworld", "nether", "end"}) {
        if (other == dimension) continue;
        const auto layouts = layoutsOf(source, other);
        if (layouts && !layouts->empty())
            others +=
                fmt::format("{} --dimension {}", others.empty() ? "; there are some with" : " and", other);
    }
    return formats::explained(source, "minecraft",
                              {base::ErrorCode::NotFound,
                               fmt::format("{}: no chunks of the {}: there is no region file r.X.Z.mca with "
                                           "chunks in {}{}",
                                           source.string(), dimension, fmt::join(names, ", "), others)});
}

}  // namespace

base::Result<std::vector<RegionSource>> regionsOf(const fs::path& source, const std::string& dimension) {
    if (isFolder(source)) {
        auto layouts = TERRANE_TRY(layoutsOf(source, dimension));
        if (layouts.empty()) return tl::unexpected(noRegions(source, dimension));
        for (std::size_t k = 1; k < layouts.size(); ++k)
            base::logWarning("{}: also has chunks, of an older version; not imported",
                             layouts[k].front().path.parent_path().string());
        return std::move(layouts.front());
    }
    std::error_code ignored;
    if (!fs::exists(source, ignored))
        return base::fail(base::ErrorCode::NotFound, "{}: there is no such file or folder", source.string());
    const auto pos = formats::regionPosOf(source.filename().string());
    if (!pos)
        return tl::unexpected(formats::explained(
            source, "minecraft",
            {base::ErrorCode::BadInput,
             fmt::format("{}: neither a folder nor a region file, which is named r.X.Z.mca",
                         source.string())}));
    std::vector<RegionSource> regions{{source, *pos}};
    keepRegionsWithChunks(regions, std::nullopt);
    if (regions.empty())
        return tl::unexpected(formats::explained(
            source, "minecraft",
            {base::ErrorCode::NotFound, fmt::format("{}: this region file has no chunks", source.string())}));
    return regions;
}

RegionChunk chunkOfRegion(formats::RegionPos region, int number) {
    return {std::int64_t{region.x} * formats::kRegionSide + number % formats::kRegionSide,
            std::int64_t{region.z} * formats::kRegionSide + number / formats::kRegionSide};
}

base::Result<std::string> readExternalChunk(const RegionSource& region, int number) {
    const auto [x, z] = chunkOfRegion(region.pos, number);
    return base::readFile(region.path.parent_path() / fmt::format("c.{}.{}.mcc", x, z),
                          formats::kMaxChunkBytes);
}

namespace {

// Chunks decoded before the import looks whether it was stopped: NBT of up to 30 MB each takes half a second.
// And those saved in a transaction.
constexpr std::size_t kDecodedAtOnce = 16, kSavedAtOnce = 128;

std::vector<int> chunksIn(const RegionSource& region, std::string_view bytes,
                          const std::optional<world::ChunkArea>& area) {
    std::vector<int> numbers;
    for (int number = 0; number < formats::kRegionChunks; ++number)
        if (isInArea(region.pos, number, area) && formats::regionHasChunk(bytes, number))
            numbers.push_back(number);
    return numbers;
}

base::Result<formats::NbtRoot> readChunkNbt(const RegionSource& region, std::string_view bytes, int number) {
    const auto nbt = TERRANE_TRY(
        formats::readRegionChunk(bytes, number, [&] { return readExternalChunk(region, number); }));
    return formats::decodeNbt(nbt);
}

struct DecodedChunk {
    world::ChunkPos pos;
    world::ChunkPtr chunk;  // null if there is a problem, or edits in the world
    bool isFinished = true, isThere = false;
    std::string problem;
    formats::ImportCounts counts;
};

class MinecraftImporter {
  public:
    MinecraftImporter(const MinecraftOptions& options, ImportWorld& world,
                      const formats::BlockMapping& mapping, const formats::LegacyIds& ids)
        : options_(options), world_(world), mapping_(mapping), ids_(ids), jobs_(world.threads) {}

    // Fails if the world cannot be written; unreadable chunks are noted in the report.
    base::Result<void> run(const std::vector<RegionSource>& regions, const Progress& progress) {
        const auto edited = TERRANE_TRY(world_.store->editedChunks());
        edited_.insert(edited.begin(), edited.end());
        for (std::size_t k = 0; k < regions.size(); ++k) {
            TERRANE_TRY(importRegion(regions[k], [&](std::size_t chunks) {
                return !progress ||
                       progress(k * formats::kRegionChunks + chunks, regions.size() * formats::kRegionChunks);
            }));
        }
        return {};
    }

    ImportReport& report() { return report_; }

  private:
    // `shouldContinue` takes the number of the region's chunks that are done.
    base::Result<void> importRegion(const RegionSource& region,
                                    const std::function<bool(std::size_t)>& shouldContinue) {
        const auto bytes = base::readFile(region.path, formats::kMaxRegionBytes);
        if (!bytes) {
            noteDamage(report_, bytes.error().message);
            return {};
        }
        const std::vector<int> wanted = chunksIn(region, *bytes, options_.area);
        std::size_t unsaved = 0;
        for (std::size_t first = 0; first < wanted.size(); first += kDecodedAtOnce) {
            const auto part =
                std::span(wanted).subspan(first, std::min(kDecodedAtOnce, wanted.size() - first));
            TERRANE_TRY(importChunks(region, *bytes, part));
            unsaved += part.size();
            const bool isStopped = !shouldContinue(static_cast<std::size_t>(part.back()) + 1);
            if (isStopped || unsaved >= kSavedAtOnce) TERRANE_TRY(world_.store->flush());
            if (unsaved >= kSavedAtOnce) unsaved = 0;
            if (isStopped)
                return base::fail("stopped after {} chunks; the same command continues", report_.chunks);
        }
        return world_.store->flush();
    }

    base::Result<void> importChunks(const RegionSource& region, std::string_view bytes,
                                    std::span<const int> numbers) {
        std::vector<DecodedChunk> decoded(numbers.size());
        TERRANE_TRY(base::parallelFor(
            jobs_, numbers.size(), [&](std::size_t k) { decoded[k] = decode(region, bytes, numbers[k]); }));
        for (DecodedChunk& chunk : decoded) {
            if (!chunk.problem.empty())
                noteDamage(report_, std::move(chunk.problem));
            else if (!chunk.isThere && !chunk.chunk)
                ++report_.empty;
            if (chunk.isThere) ++report_.skipped;
            if (!chunk.chunk) continue;
            ++report_.chunks;
            report_.unfinished += chunk.isFinished ? 0 : 1;
            addTo(report_.counts, chunk.counts);
            world_.store->save(chunk.pos, std::move(chunk.chunk), store::Provenance::Edited);
        }
        return {};
    }

    DecodedChunk decode(const RegionSource& region, std::string_view bytes, int number) const {
        DecodedChunk result;
        const auto problem = [&](const base::Error& error) {
            result.problem =
                fmt::format("{}: chunk {},{}: {}", region.path.string(), number % formats::kRegionSide,
                            number / formats::kRegionSide, error.message);
            return std::move(result);
        };
        const auto root = readChunkNbt(region, bytes, number);
        if (!root) return problem(root.error());
        const auto chunk = formats::decodeAnvilChunk(root->compound, ids_);
        if (!chunk) return problem(chunk.error());
        const auto [x, z] = chunkOfRegion(region.pos, number);
        if (chunk->x != x || chunk->z != z)
            return problem({base::ErrorCode::Damaged,
                            fmt::format("claims to be chunk {},{} of the world, but is stored as {},{}",
                                        chunk->x, chunk->z, x, z)});
        if (x < world::kMinChunk || x > world::kMaxChunk || z < world::kMinChunk || z > world::kMaxChunk)
            return problem({base::ErrorCode::BadInput, "is outside the world"});
        result.pos = world::offsetBy(formats::chunkPosOf(*chunk), options_.at.x, options_.at.y);
        if (!world::isInWorld(result.pos))
            return problem({base::ErrorCode::BadInput, "is outside the world"});
        result.isThere = edited_.contains(result.pos);
        if (result.isThere || chunk->sections.empty()) return result;
        result.isFinished = chunk->isFinished;
        result.chunk = std::make_shared<const world::Chunk>(formats::toChunk(
            *chunk, mapping_, {options_.shift, world_.store->identity().heights}, result.counts));
        return result;
    }

    const MinecraftOptions& options_;
    ImportWorld& world_;
    const formats::BlockMapping& mapping_;
    const formats::LegacyIds& ids_;
    base::JobSystem jobs_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> edited_;
    ImportReport report_;
};

}  // namespace

namespace {

// The sections with blocks of all chunks; those that cannot be read have none, and the import reports them.
base::Result<std::optional<formats::SectionRange>> sectionsOf(std::span<const RegionSource> regions,
                                                              const std::optional<world::ChunkArea>& area,
                                                              unsigned threads, const Progress& progress) {
    base::JobSystem jobs(threads);
    std::optional<formats::SectionRange> all;
    const auto add = [&](const std::optional<formats::SectionRange>& range) {
        if (!range) return;
        all = !all ? *range
                   : formats::SectionRange{std::min(all->lowest, range->lowest),
                                           std::max(all->highest, range->highest)};
    };
    for (const RegionSource& region : regions) {
        if (progress && !progress(0, regions.size() * formats::kRegionChunks))
            return base::fail("stopped before the first chunk");
        const auto bytes = base::readFile(region.path, formats::kMaxRegionBytes);
        if (!bytes) continue;
        const std::vector<int> numbers = chunksIn(region, *bytes, area);
        std::vector<std::optional<formats::SectionRange>> ranges(numbers.size());
        TERRANE_TRY(base::parallelFor(jobs, numbers.size(), [&](std::size_t k) {
            const auto root = readChunkNbt(region, *bytes, numbers[k]);
            if (root) ranges[k] = formats::sectionRangeOf(root->compound);
        }));
        for (const auto& range : ranges) add(range);
    }
    return all;
}

// The heights of a new world that loses no block: 0 to 255, and all sections of the chunks.
world::Heights heightsFor(const std::optional<formats::SectionRange>& sections, int shift) {
    world::Heights heights;
    if (!sections) return heights;
    const auto border = [](std::int64_t z) {
        return static_cast<int>(std::clamp<std::int64_t>(z, world::kLowestBottom, world::kHighestTop));
    };
    const auto down = [](std::int64_t z) { return z >> 4 << 4; };
    heights.bottom = std::min(heights.bottom, border(down(std::int64_t{sections->lowest} * 16 + shift)));
    heights.top = std::max(heights.top, border(down(std::int64_t{sections->highest} * 16 + 16 + shift + 15)));
    return heights;
}

bool isNewWorld(const ImportOptions& options) {
    return !store_postgres::anyWorldMetadata(store::worldLocation(options.save.world)).has_value();
}

}  // namespace

base::Result<ImportReport> importMinecraft(ImportOptions& options, const MinecraftOptions& minecraft,
                                           const Progress& progress) {
    auto regions = TERRANE_TRY(regionsOf(options.source, minecraft.dimension));
    keepRegionsWithChunks(regions, minecraft.area);
    if (regions.empty())
        return base::fail(base::ErrorCode::NotFound, "{}: no chunks in --area", options.source.string());
    const auto ids = TERRANE_TRY(formats::builtInLegacyIds());
    auto content = TERRANE_TRY(loadContent(options.world, options.save));
    const auto mapping = TERRANE_TRY(formats::loadMapping(*content.blocks, options.mapping));
    if (!options.world.heights.bottom && !options.world.heights.top && isNewWorld(options)) {
        const auto sections =
            TERRANE_TRY(sectionsOf(regions, minecraft.area, threadCount(options.world), progress));
        options.world.heights = heightsFor(sections, minecraft.shift);
    }
    auto world = TERRANE_TRY(openImportWorld(options, std::move(content)));
    MinecraftImporter importer(minecraft, world, mapping, ids);
    TERRANE_TRY(importer.run(regions, progress));
    return std::move(importer.report());
}

}  // namespace terrane::io
