// terrane packs: lists, checks and creates content packs.
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/platform.h"
#include "terrane/base/text.h"
#include "terrane/content/language.h"
#include "terrane/io/open_session.h"
#include "terrane/pack/installed_packs.h"
#include "terrane/pack/pack.h"
#include "terrane/pack/pack_files.h"
#include "terrane/rules/rules.h"

namespace terrane::app {
namespace {

enum class PacksAction { List, Check, Init };

struct PacksOptions {
    PacksAction action = PacksAction::List;
    std::vector<std::string> names;
    bool json = false;
};

// The names of a pack's generators, from the paths of its files.
std::vector<std::string> generatorsOf(const pack::Pack& pack) {
    std::vector<std::string> names;
    for (const auto& [path, data] : pack.files)
        if (path.starts_with("generators/"))
            names.push_back(pack::qualifiedName(pack, std::filesystem::path(path).stem().string()));
    return names;
}

nlohmann::json packJson(const pack::Pack& pack) {
    return {{"name", pack.info.name},
            {"version", pack.info.version},
            {"title", pack.info.title},
            {"description", pack.info.description},
            {"license", pack.info.license},
            {"authors", pack.info.authors},
            {"requires", pack.info.requiredPacks},
            {"generators", generatorsOf(pack)},
            {"where", pack.where},
            {"hash", pack::hexOf(pack::hashOf(pack))}};
}

void printPack(const pack::Pack& pack) {
    base::printLine("{:<16} {:<8} {}", pack.info.name, pack.info.version, pack.info.title);
    if (!pack.where.empty()) base::printLine("  {}", pack.where);
    if (const auto generators = generatorsOf(pack); !generators.empty())
        base::printLine("  --generator {}", fmt::join(generators, ", "));
}

base::Result<void> listPacks(const PacksOptions& options) {
    std::vector<pack::Pack> packs;
    auto builtIn = TERRANE_TRY(pack::builtInPack());
    packs.push_back(std::move(builtIn));
    for (const std::filesystem::path& folder : pack::packFolders())
        for (const std::filesystem::path& path : pack::packsIn(folder)) {
            auto read = pack::readPack(path);
            if (read)
                packs.push_back(std::move(*read));
            else
                base::logWarning("{}", read.error().message);
        }
    if (options.json) {
        nlohmann::json all = nlohmann::json::array();
        for (const pack::Pack& pack : packs) all.push_back(packJson(pack));
        std::cout << all.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) << '\n';
        return {};
    }
    for (const pack::Pack& pack : packs) printPack(pack);
    return {};
}

// Warns about likely mistakes: textures that no block uses, and names of missing blocks.
void warnOfSlips(const pack::Pack& pack, const world::BlockRegistry& blocks) {
    for (const auto& [path, data] : pack.files) {
        const std::string name = pack::qualifiedName(pack, std::filesystem::path(path).stem().string());
        if (path.starts_with("textures/") &&
            std::ranges::find(blocks.textures(), name) == blocks.textures().end())
            base::logWarning("{}: no block uses this texture", pack::displayPath(pack, path));
        if (!path.starts_with("languages/")) continue;
        const auto language = content::parseLanguage(data, pack::displayPath(pack, path));
        if (!language) continue;
        for (const auto& [block, shown] : language->blocks)
            if (!blocks.find(pack::qualifiedName(pack, block)))
                base::logWarning("{}: blocks.{}: the pack has no such block", pack::displayPath(pack, path),
                                 block);
    }
}

// Loads each pack alone, with the packs that it requires, which finds all its errors.
base::Result<void> checkPacks(const PacksOptions& options) {
    if (options.names.empty())
        return base::fail(base::ErrorCode::BadInput, "packs check: expected the name of a pack");
    for (const std::string& name : options.names) {
        io::WorldOptions world;
        world.content = {name};
        const auto content = TERRANE_TRY(io::loadContent(world));
        const auto read = TERRANE_TRY(pack::readPacks({name}));
        const pack::Pack& pack = read.front();
        warnOfSlips(pack, *content.blocks);
        TERRANE_TRY(rules::checkScripts(content));
        const auto isOwn = [&](const world::BlockType& type) {
            return type.name.starts_with(pack.info.name + ":");
        };
        const auto blocks = std::ranges::count_if(content.blocks->types(), isOwn);
        base::printLine(
            "{}: good: {}, {}, {}", name, base::counted(static_cast<std::size_t>(blocks), "block"),
            base::counted(generatorsOf(pack).size(), "generator"), base::counted(pack.files.size(), "file"));
    }
    return {};
}

// In the folder that is searched for packs, unless a path is given.
base::Result<std::filesystem::path> newFolder(const std::string& nameOrPath) {
    const std::filesystem::path path(nameOrPath);
    if (!pack::isPackName(path.filename().string()))
        return base::fail(base::ErrorCode::BadInput,
                          "packs init: a name has 1 to {} characters of a-z, 0-9 and _, got \"{}\"",
                          pack::kMaxPackName, base::printable(path.filename().string()));
    if (path.has_parent_path()) return path;
    const auto folders = pack::packFolders();
    if (folders.empty())
        return base::fail(base::ErrorCode::NotFound, "packs init: set {}, or name a path, ./{}",
                          base::platform::dataFolderVariables(), nameOrPath);
    return folders.front() / path;
}

base::Result<void> initPack(const PacksOptions& options) {
    if (options.names.size() != 1)
        return base::fail(base::ErrorCode::BadInput, "packs init: expected one name");
    const auto folder = TERRANE_TRY(newFolder(options.names.front()));
    TERRANE_TRY(pack::writeSkeleton(folder));
    const std::string name = folder.filename().string();
    const std::string given = options.names.front().find('/') == std::string::npos ? name : folder.string();
    base::printLine("{}", folder.string());
    base::printLine("terrane play --content {} --generator {}:{} --watch", given, name,
                    pack::kSkeletonGenerator);
    return {};
}

base::Result<void> packs(const PacksOptions& options) {
    switch (options.action) {
        case PacksAction::List:
            return listPacks(options);
        case PacksAction::Check:
            return checkPacks(options);
        case PacksAction::Init:
            return initPack(options);
    }
    return {};
}

}  // namespace

CommandEntry addPacks(CLI::App& app) {
    auto options = std::make_shared<PacksOptions>();
    CLI::App* command = app.add_subcommand("packs", "List, check or create content packs");
    addChoice<PacksAction>(
        *command, "action", options->action,
        {{"list", PacksAction::List}, {"check", PacksAction::Check}, {"init", PacksAction::Init}},
        "What to do. init writes a pack that works at once, in $XDG_DATA_HOME/terrane/packs");
    command
        ->add_option("pack", options->names,
                     "Names of packs in the packs folder, or paths, which have a slash (./isles)")
        ->type_name("PACK");
    command->add_flag("--json", options->json, "Print the list as JSON");
    return {command, [options] { return packs(*options); }};
}

}  // namespace terrane::app
