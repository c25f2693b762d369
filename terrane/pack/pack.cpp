#include "terrane/pack/pack.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/text.h"
#include "terrane/content/built_in.h"
#include "terrane/world/blocks/content_table.h"

namespace terrane::pack {

namespace {

constexpr std::string_view kInfoFile = "pack.toml";
constexpr int kFormat = 1;
constexpr std::size_t kMaxInfoText = 1024;  // bytes
constexpr std::size_t kMaxListed = 64;      // authors, required packs

constexpr std::array<std::string_view, 9> kInfoKeys{"format",  "name",    "version",  "title", "description",
                                                    "license", "authors", "requires", "rules"};

// The name of a file without folder and ending; empty if the path is another kind of file.
std::string_view nameIn(std::string_view path, std::string_view folder, std::string_view ending) {
    if (!path.starts_with(folder) || !path.ends_with(ending) || path.size() <= folder.size() + ending.size())
        return {};
    const std::string_view name = path.substr(folder.size(), path.size() - folder.size() - ending.size());
    const bool isName = name.size() <= kMaxFileName &&
                        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == name.npos;
    return isName ? name : std::string_view();
}

std::string textOf(world::ContentTable& table, std::string_view key) {
    const toml::node* node = table.node(key);
    if (!node) return {};
    const auto text = node->value_exact<std::string>();
    if (!text || text->size() > kMaxInfoText)
        table.expected(*node, key, fmt::format("a text of at most {} bytes", kMaxInfoText));
    return text.value_or("");
}

std::vector<std::string> textsOf(world::ContentTable& table, std::string_view key) {
    const toml::node* node = table.node(key);
    if (!node) return {};
    const toml::array* list = node->as_array();
    std::vector<std::string> texts;
    for (std::size_t k = 0; list && k < list->size() && k < kMaxListed; ++k)
        if (const auto text = (*list)[k].value_exact<std::string>(); text && text->size() <= kMaxInfoText)
            texts.push_back(*text);
    if (!list || texts.size() != list->size())
        table.expected(*node, key, fmt::format("at most {} texts", kMaxListed));
    return texts;
}

void readName(world::ContentTable& table, PackInfo& info) {
    const toml::node* name = table.node("name");
    if (!name) return table.missing("name");
    info.name = textOf(table, "name");
    if (!isPackName(info.name))
        table.expected(*name, "name", fmt::format("1 to {} of a-z, 0-9 and _", kMaxPackName));
}

base::Result<PackInfo> readInfo(const toml::table& root, std::string_view file) {
    std::optional<std::string> error;
    world::ContentTable table(root, file, error);
    table.rejectUnknown(kInfoKeys);
    PackInfo info;
    if (const toml::node* format = table.node("format"))
        table.numberOf(*format, "format", kFormat, kFormat);
    else
        table.missing("format", "format = 1");
    readName(table, info);
    info.version = textOf(table, "version");
    info.title = textOf(table, "title");
    info.description = textOf(table, "description");
    info.license = textOf(table, "license");
    info.authors = textsOf(table, "authors");
    info.requiredPacks = textsOf(table, "requires");
    for (const std::string& name : info.requiredPacks)
        if (!isPackName(name)) table.expected(*table.node("requires"), "requires", "names of packs");
    if (const toml::node* rules = table.node("rules")) {
        info.rules = static_cast<int>(rules->value_exact<std::int64_t>().value_or(0));
        if (info.rules != kRulesVersion)
            table.expected(
                *rules, "rules",
                fmt::format("{}, the version of this program's interface for rules", kRulesVersion));
    }
    if (error) return base::fail(base::ErrorCode::BadInput, "{}", base::inOneLine(*error));
    return info;
}

// Without the line of the key `rules`, which readers of packs without scripts do not know.
std::string withoutRules(std::string_view toml) {
    std::string kept;
    while (!toml.empty()) {
        const std::string_view line = toml.substr(0, std::min(toml.find('\n'), toml.size() - 1) + 1);
        toml.remove_prefix(line.size());
        std::string_view key = line.substr(0, line.find('='));
        while (key.ends_with(' ') || key.ends_with('\t')) key.remove_suffix(1);
        while (key.starts_with(' ') || key.starts_with('\t')) key.remove_prefix(1);
        if (key != "rules" || key.size() == line.size()) kept += line;
    }
    return kept;
}

base::Result<void> checkSizes(const PackFiles& files, const std::string& where) {
    std::size_t generators = 0, scripts = 0;
    for (const auto& [path, data] : files) {
        const bool isScript = path.ends_with(".lua");
        const std::size_t most = isScript ? kMaxScriptBytes : kMaxTableBytes;
        if (data.size() > most && !path.ends_with(".png"))
            return base::fail(base::ErrorCode::BadInput, "{}/{}: more than {} KiB", where, path, most >> 10);
        if (isScript) ++(path.starts_with(kScripts) ? scripts : generators);
        if (generators > kMaxGenerators)
            return base::fail(base::ErrorCode::BadInput, "{}: more than {} generators", where,
                              kMaxGenerators);
        if (scripts > kMaxRuleScripts)
            return base::fail(base::ErrorCode::BadInput, "{}: more than {} scripts", where, kMaxRuleScripts);
    }
    return {};
}

}  // namespace

bool isPackName(std::string_view text) {
    return !text.empty() && text.size() <= kMaxPackName &&
           text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
}

bool hasPack(const std::vector<Pack>& packs, std::string_view name) {
    return std::ranges::any_of(packs, [&](const Pack& pack) { return pack.info.name == name; });
}

bool isPackPath(std::string_view path) {
    return path == kInfoFile || path == "blocks.toml" || path == "items.toml" ||
           !nameIn(path, "textures/", ".png").empty() || !nameIn(path, "generators/", ".lua").empty() ||
           !nameIn(path, kScripts, ".lua").empty() || !nameIn(path, "languages/", ".toml").empty();
}

PackFiles clientFiles(const PackFiles& files) {
    PackFiles needed;
    for (const auto& [path, data] : files)
        if (!path.starts_with(kScripts)) needed.emplace(path, path == kInfoFile ? withoutRules(data) : data);
    return needed;
}

base::Result<Pack> makePack(PackFiles files, std::string where) {
    const auto info = files.find(kInfoFile);
    if (info == files.end())
        return base::fail(base::ErrorCode::BadInput, "{}: not a content pack: there is no pack.toml", where);
    TERRANE_TRY(checkSizes(files, where));
    Pack pack{{}, {}, std::move(where)};
    const std::string file = pack.where + "/pack.toml";
    pack.info = TERRANE_TRY(readInfo(TERRANE_TRY(base::parseToml(info->second, file)), file));
    for (const auto& [path, data] : files)
        if (path.starts_with(kScripts) && pack.info.rules == 0)
            return base::fail(base::ErrorCode::BadInput, "{}: {} needs rules = {} in this file", file, path,
                              kRulesVersion);
    pack.files = std::move(files);
    return pack;
}

std::string displayPath(const Pack& pack, std::string_view path) {
    return pack.where.empty() ? std::string(path) : fmt::format("{}/{}", pack.where, path);
}

std::string qualifiedName(const Pack& pack, std::string_view name) {
    return pack.info.name == kBuiltInPack ? std::string(name) : fmt::format("{}:{}", pack.info.name, name);
}

base::Result<Pack> builtInPack() {
    PackFiles files;
    for (const content::BuiltInFile& file : content::builtInFiles())
        if (isPackPath(file.path)) files.emplace(file.path, file.data);
    return makePack(std::move(files), "");
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder = "skeleton/", kNamePlace = "PACK_NAME";
constexpr const char* kSubfolders[] = {"textures", "generators", "languages", "scripts"};

std::string withName(std::string_view text, const std::string& name) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t found = text.find(kNamePlace, at);
        result += text.substr(at, found - at);
        if (found == text.npos) break;
        result += name;
        at = found + kNamePlace.size();
    }
    return result;
}

}  // namespace

namespace {

base::Result<void> writeFiles(const fs::path& folder, const std::string& name) {
    std::error_code error;
    for (const char* inside : kSubfolders) {
        fs::create_directories(folder / inside, error);
        if (error) return base::fail("{}: cannot be made: {}", (folder / inside).string(), error.message());
    }
    for (const content::BuiltInFile& file : content::builtInFiles()) {
        if (!file.path.starts_with(kFolder)) continue;
        const fs::path path = folder / file.path.substr(kFolder.size());
        const bool isText = path.extension() != ".png";
        TERRANE_TRY(base::writeFile(path, isText ? withName(file.data, name) : std::string(file.data)));
    }
    return {};
}

}  // namespace

base::Result<void> writeSkeleton(const fs::path& folder) {
    const std::string name = folder.filename().string();
    if (!isPackName(name))
        return base::fail(base::ErrorCode::BadInput,
                          "{}: a pack's name has 1 to {} characters of a-z, 0-9 and _", folder.string(),
                          kMaxPackName);
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)))
        return base::fail(base::ErrorCode::BadInput, "{}: exists already", folder.string());
    const base::Result<void> written = writeFiles(folder, name);
    if (!written) fs::remove_all(folder, error);
    return written;
}

}  // namespace terrane::pack
