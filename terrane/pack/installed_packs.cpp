#include "terrane/pack/installed_packs.h"

#include <sstream>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/text.h"
#include "terrane/pack/pack_files.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::pack {

namespace {

constexpr std::size_t kMaxRequired = 256;

// A pack that is found by its name must have that name: worlds and other packs refer to it.
base::Result<Pack> readNamed(const std::string& nameOrPath) {
    const auto path = TERRANE_TRY(findPack(nameOrPath, packFolders()));
    auto read = readPack(path);
    const bool isNamed = isPackName(nameOrPath) && path != std::filesystem::path(nameOrPath);
    if (read && isNamed && read->info.name != nameOrPath)
        return base::fail(
            base::ErrorCode::BadInput,
            "{}: this pack is called \"{}\": in the packs folder, give its folder or file that name",
            path.string(), read->info.name);
    return read;
}

}  // namespace

std::vector<std::filesystem::path> packFolders() {
    const auto folder = store::dataFolder(store::saveEnvironment());
    return folder ? std::vector{*folder / "packs"} : std::vector<std::filesystem::path>();
}

base::Result<std::vector<Pack>> readPacks(const std::vector<std::string>& namesOrPaths) {
    std::vector<Pack> packs;
    for (const std::string& nameOrPath : namesOrPaths) {
        if (hasPack(packs, nameOrPath)) continue;  // its path was given before
        auto read = TERRANE_TRY(readNamed(nameOrPath));
        packs.push_back(std::move(read));
    }
    return packs;
}

base::Result<void> addPacks(std::vector<Pack>& packs, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (hasPack(packs, name)) continue;
        auto read = readNamed(name);
        if (read) {
            packs.push_back(std::move(*read));
        } else if (read.error().code == base::ErrorCode::NotFound) {
            base::logWarning("the world was made with the content pack \"{}\": {}", name,
                             read.error().message);
        } else {
            return tl::unexpected(read.error());
        }
    }
    return {};
}

base::Result<void> addRequiredPacks(std::vector<Pack>& packs) {
    for (std::size_t k = 0; k < packs.size() && packs.size() < kMaxRequired; ++k) {
        const std::vector<std::string> required = packs[k].info.requiredPacks;
        for (const std::string& name : required) {
            if (hasPack(packs, name) || name == kBuiltInPack) continue;
            auto read = readNamed(name);
            if (!read)
                return base::fail(read.error().code, "{}/pack.toml: requires: {}", packs[k].where,
                                  read.error().message);
            packs.push_back(std::move(*read));
        }
    }
    return {};
}

base::Result<Content> reloadPacks(const Content& content) {
    std::vector<std::string> paths;
    for (const Pack& pack : *content.packs)
        if (pack.info.name != kBuiltInPack) paths.push_back(pack.where);
    auto packs = TERRANE_TRY(readPacks(paths));
    TERRANE_TRY(addRequiredPacks(packs));
    return loadContent(std::move(packs));
}

namespace {

constexpr std::string_view kPacksMetadata = "packs";
constexpr std::size_t kMaxWorldPacks = 256;

std::string nameIn(const std::string& line) {
    return line.substr(0, line.find(' '));
}

std::vector<std::string> linesOf(const std::string& metadata) {
    std::vector<std::string> lines;
    std::istringstream text(metadata);
    for (std::string line; std::getline(text, line) && lines.size() < kMaxWorldPacks;)
        if (isPackName(nameIn(line))) lines.push_back(line);
    return lines;
}

}  // namespace

std::vector<std::string> savedPackNames(const store::Metadata& metadata) {
    const auto found = metadata.find(kPacksMetadata);
    std::vector<std::string> names;
    if (found != metadata.end())
        for (const std::string& line : linesOf(found->second)) names.push_back(nameIn(line));
    return names;
}

void savePackNames(store::ChunkStore& store, const Content& content) {
    const std::string before = store.metadata(kPacksMetadata).value_or("");
    std::string lines;
    for (const Pack& pack : *content.packs)
        if (pack.info.name != kBuiltInPack)
            lines += fmt::format("{} {} {}\n", pack.info.name,
                                 pack.info.version.empty() ? "-" : base::printable(pack.info.version),
                                 hexOf(hashOf(pack)));
    // The world may still have blocks of packs that are not loaded now.
    for (const std::string& line : linesOf(before))
        if (!hasPack(*content.packs, nameIn(line))) lines += line + "\n";
    if (before != lines) store.setMetadata(kPacksMetadata, std::move(lines));
}

}  // namespace terrane::pack
