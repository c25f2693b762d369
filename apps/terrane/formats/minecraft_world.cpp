#include "apps/terrane/formats/minecraft_world.h"

#include <algorithm>
#include <tuple>

#include "terrane/base/files.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;

// Limit on a folder: 2^20 regions of 512² blocks, 1,024 × 1,024 of them, are 524,288 blocks a side.
constexpr std::size_t kMaxRegions = std::size_t{1} << 20;

bool isFolder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

// Folders that may hold the dimension's regions: those of a world, or the named folder itself.
std::vector<fs::path> regionFolders(const fs::path& source, const std::string& dimension) {
    const fs::path own = source / "dimensions" / "minecraft";
    if (dimension == "nether") return {source / "DIM-1" / "region", own / "the_nether" / "region"};
    if (dimension == "end") return {source / "DIM1" / "region", own / "the_end" / "region"};
    return {source / "region", own / "overworld" / "region", source};
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

}  // namespace

base::Result<std::vector<RegionSource>> regionsOf(const fs::path& source, const std::string& dimension) {
    if (!isFolder(source)) {
        const auto pos = formats::regionPosOf(source.filename().string());
        if (!pos)
            return base::fail(base::ErrorCode::BadInput,
                              "{}: neither a folder nor a region file, which is named r.X.Z.mca",
                              source.string());
        return std::vector<RegionSource>{{source, *pos}};
    }
    for (const fs::path& folder : regionFolders(source, dimension)) {
        if (!isFolder(folder)) continue;
        auto regions = regionsIn(folder);
        if (!regions || !regions->empty()) return regions;
    }
    return base::fail(base::ErrorCode::NotFound, "{}: there are no region files r.X.Z.mca of the {}",
                      source.string(), dimension);
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

}  // namespace terrane::app
