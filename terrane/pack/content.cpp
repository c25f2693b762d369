#include "terrane/pack/content.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "terrane/base/machine.h"
#include "terrane/base/names.h"
#include "terrane/content/built_in.h"
#include "terrane/content/resource_pack.h"
#include "terrane/lua/script.h"
#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/items/item_table.h"

namespace terrane::pack {

namespace {

base::Result<void> checkRequired(const std::vector<Pack>& packs) {
    std::set<std::string_view> names{kBuiltInPack};
    for (const Pack& pack : packs)
        if (!names.insert(pack.info.name).second)
            return base::fail(base::ErrorCode::BadInput, "{}/pack.toml: name: there is another pack \"{}\"",
                              pack.where, pack.info.name);
    std::vector<std::string> known{std::string(kBuiltInPack)};
    for (const Pack& pack : packs) {
        if (const std::string like = base::nameLike(pack.info.name, known); !like.empty())
            return base::fail(base::ErrorCode::BadInput,
                              "{}/pack.toml: name: \"{}\" looks like the name of the pack \"{}\"", pack.where,
                              pack.info.name, like);
        known.push_back(pack.info.name);
    }
    for (const Pack& pack : packs)
        for (const std::string& name : pack.info.requiredPacks)
            if (!names.contains(name))
                return base::fail(base::ErrorCode::BadInput,
                                  "{}/pack.toml: requires: the pack \"{}\" is not loaded", pack.where, name);
    return {};
}

}  // namespace

base::Result<std::vector<Pack>> loadOrder(Pack builtIn, std::vector<Pack> packs) {
    TERRANE_TRY(checkRequired(packs));
    std::vector<Pack> ordered;
    std::set<std::string> done{std::string(kBuiltInPack)};
    ordered.push_back(std::move(builtIn));
    while (!packs.empty()) {
        const auto next = std::ranges::find_if(packs, [&](const Pack& pack) {
            return std::ranges::all_of(pack.info.requiredPacks,
                                       [&](const std::string& name) { return done.contains(name); });
        });
        if (next == packs.end())
            return base::fail(base::ErrorCode::BadInput,
                              "{}/pack.toml: requires: packs require each other in a circle",
                              packs.front().where);
        done.insert(next->info.name);
        ordered.push_back(std::move(*next));
        packs.erase(next);
    }
    return ordered;
}

namespace {

const std::string* fileOf(const Pack& pack, std::string_view path) {
    const auto found = pack.files.find(path);
    return found == pack.files.end() ? nullptr : &found->second;
}

std::string texturePath(std::string_view name) {
    return fmt::format("textures/{}.png", name);
}

// The pack's own texture, or the built-in one.
std::string textureName(const Pack& pack, const Pack& builtIn, const std::string& name) {
    if (fileOf(pack, texturePath(name))) return qualifiedName(pack, name);
    return fileOf(builtIn, texturePath(name)) ? name : std::string();
}

base::Result<void> qualifyTextures(const Pack& pack, const Pack& builtIn, world::BlockDescription& block) {
    const auto qualify = [&](world::FaceDescription& face) -> base::Result<void> {
        std::string name = textureName(pack, builtIn, face.texture);
        if (name.empty())
            return base::fail(base::ErrorCode::BadInput,
                              "{}:{}: texture: there is no textures/{}.png in the pack, and no built-in one",
                              block.file, block.line, face.texture);
        face.texture = std::move(name);
        return {};
    };
    for (world::FaceDescription& face : block.faces) TERRANE_TRY(qualify(face));
    for (world::FaceDescription& face : block.growth) TERRANE_TRY(qualify(face));
    return {};
}

// The blocks of the packs read so far.
struct BlockCollector {
    const world::BehaviorTable& behaviors;
    std::vector<world::BlockDescription> blocks;
    std::vector<world::ShapePtr> builtInShapes;
    std::vector<world::ItemFile> items;
};

using Names = std::unordered_set<std::string>;

// Blocks and items that the pack names are its own ones if it has them.
void qualify(const Pack& pack, const Names& own, std::string& name) {
    if (own.contains(name)) name = qualifiedName(pack, name);
}

void qualifyBlocks(const Pack& pack, std::vector<world::BlockDescription>& blocks, const Names& ownItems) {
    Names own;
    for (const world::BlockDescription& block : blocks) own.insert(block.type.name);
    for (world::BlockDescription& block : blocks) {
        block.type.name = qualifiedName(pack, block.type.name);
        qualify(pack, ownItems, block.type.drop.item);
        for (world::BehaviorCall& call : block.calls)
            for (auto& [parameter, name] : call.arguments.blocks) qualify(pack, own, name);
    }
}

base::Result<void> qualifyItems(const Pack& pack, const Pack& builtIn, const Names& own,
                                world::ItemFile& file) {
    for (std::size_t k = 0; k < file.items.size(); ++k) {
        world::ItemType& item = file.items[k];
        item.name = qualifiedName(pack, item.name);
        std::string texture = textureName(pack, builtIn, item.texture);
        if (texture.empty())
            return base::fail(base::ErrorCode::BadInput,
                              "{}:{}: texture: there is no textures/{}.png in the pack, and no built-in one",
                              displayPath(pack, "items.toml"), file.itemLines[k], item.texture);
        item.texture = std::move(texture);
    }
    for (world::Recipe& recipe : file.recipes) {
        qualify(pack, own, recipe.makes);
        for (world::Recipe::Ingredient& ingredient : recipe.ingredients)
            for (std::string& name : ingredient) qualify(pack, own, name);
    }
    return {};
}

// Reads the blocks and items of a pack.
base::Result<void> readTypes(const Pack& pack, const Pack& builtIn, BlockCollector& collector) {
    const std::string* text = fileOf(pack, "blocks.toml");
    const std::string* itemText = fileOf(pack, "items.toml");
    auto read = TERRANE_TRY(world::parseBlocks(text ? *text : std::string(), displayPath(pack, "blocks.toml"),
                                               collector.behaviors, collector.builtInShapes));
    auto items =
        TERRANE_TRY(world::parseItems(itemText ? *itemText : std::string(), displayPath(pack, "items.toml")));
    Names own;
    for (const world::BlockDescription& block : read.blocks) own.insert(block.type.name);
    for (const world::ItemType& item : items.items) own.insert(item.name);
    for (world::BlockDescription& block : read.blocks) TERRANE_TRY(qualifyTextures(pack, builtIn, block));
    qualifyBlocks(pack, read.blocks, own);
    TERRANE_TRY(qualifyItems(pack, builtIn, own, items));
    collector.items.push_back(std::move(items));
    std::ranges::move(read.blocks, std::back_inserter(collector.blocks));
    if (&pack == &builtIn) collector.builtInShapes = std::move(read.shapes);
    return {};
}

// Textures by the names that blocks use for them.
world::TextureSource texturesOf(std::shared_ptr<const std::vector<Pack>> packs) {
    return [packs = std::move(packs)](std::string_view name) -> base::Result<base::Image> {
        const auto colon = name.find(':');
        const std::string_view prefix = colon == name.npos ? kBuiltInPack : name.substr(0, colon);
        const std::string path = texturePath(colon == name.npos ? name : name.substr(colon + 1));
        for (const Pack& pack : *packs)
            if (const std::string* data = pack.info.name == prefix ? fileOf(pack, path) : nullptr)
                return base::decodePng(*data, displayPath(pack, path));
        return base::fail("{}: there is none in the pack {}", path, prefix);
    };
}

// All textures of a session are in one array, as wide as the widest.
constexpr std::size_t kMaxTextureBytes = std::size_t{1} << 30;

// Decodes the textures of packs once to find errors.
base::Result<void> checkTextures(const std::vector<Pack>& packs, std::size_t count) {
    std::size_t widest = 16, pixelBytes = 0;
    for (const Pack& pack : packs) {
        if (pack.info.name == kBuiltInPack) continue;
        for (const auto& [path, data] : pack.files) {
            if (!path.starts_with("textures/")) continue;
            const auto image = TERRANE_TRY(
                base::decodePng(data, displayPath(pack, path),
                                std::int64_t{content::kMaxTextureSide} * content::kMaxTextureSide));
            TERRANE_TRY(content::checkTexture(image, displayPath(pack, path)));
            widest = std::max(widest, static_cast<std::size_t>(image.width));
            pixelBytes += image.rgba.size();
            if (pixelBytes > kMaxTextureBytes)
                return base::fail(base::ErrorCode::BadInput,
                                  "the textures of the packs have more than {} MiB", kMaxTextureBytes >> 20);
        }
    }
    if (widest * widest * 4 * count > kMaxTextureBytes)
        return base::fail(base::ErrorCode::BadInput,
                          "{} textures as wide as the widest, {} pixels, take more than {} MiB", count,
                          widest, kMaxTextureBytes >> 20);
    return {};
}

base::Result<void> checkLanguages(const Pack& pack) {
    for (const auto& [path, text] : pack.files)
        if (path.starts_with("languages/"))
            (void)TERRANE_TRY(content::parseLanguage(text, displayPath(pack, path)));
    return {};
}

// CPU time. Packs of servers must not block a client for minutes: a script may take 100 ms a level.
constexpr std::chrono::seconds kLongestRecording{10};

// Records each script of a pack.
base::Result<void> addGenerators(const Pack& pack, const world::BlockRegistry& blocks,
                                 std::chrono::nanoseconds until, gen::GeneratorCatalogue& generators) {
    constexpr std::string_view kFolder = "generators/", kEnding = ".lua";
    for (auto file = pack.files.lower_bound(kFolder);
         file != pack.files.end() && file->first.starts_with(kFolder); ++file) {
        const std::string_view path = file->first;
        const std::string name =
            qualifiedName(pack, path.substr(kFolder.size(), path.size() - kFolder.size() - kEnding.size()));
        const auto script =
            std::make_shared<const lua::Script>(lua::Script{file->second, displayPath(pack, path)});
        const lua::ScriptNames names{name, pack.info.name == kBuiltInPack ? std::string() : pack.info.name};
        if (base::threadTime() > until)
            return base::fail(base::ErrorCode::BadInput, "{}: the scripts of the packs take more than {} s",
                              displayPath(pack, path), kLongestRecording.count());
        const auto version = TERRANE_TRY(lua::scriptVersion(*script, names, blocks));
        const auto record = [script, names](const world::BlockRegistry& registry, gen::GraphRequest request) {
            return lua::recordScript(*script, names, registry, request);
        };
        generators.push_back({name, version, record});
    }
    return {};
}

}  // namespace

base::Result<Content> loadContent(std::vector<Pack> packs, const world::BehaviorTable& behaviors) {
    auto builtIn = TERRANE_TRY(builtInPack());
    auto ordered = TERRANE_TRY(loadOrder(std::move(builtIn), std::move(packs)));
    Content content;
    content.packs = std::make_shared<const std::vector<Pack>>(std::move(ordered));

    BlockCollector collector{behaviors, {}, {}, {}};
    for (const Pack& pack : *content.packs) TERRANE_TRY(readTypes(pack, content.packs->front(), collector));
    auto blocks = TERRANE_TRY(
        world::BlockRegistry::fromDescriptions(std::move(collector.blocks), "blocks.toml", collector.items));
    TERRANE_TRY(world::checkItemNames(blocks));
    content.blocks = std::make_shared<const world::BlockRegistry>(std::move(blocks));
    TERRANE_TRY(checkTextures(*content.packs, content.blocks->textures().size()));
    content.textures = texturesOf(content.packs);
    content.generators = gen::builtInGenerators();
    const std::chrono::nanoseconds until = base::threadTime() + kLongestRecording;
    for (const Pack& pack : *content.packs) TERRANE_TRY(checkLanguages(pack));
    for (const Pack& pack : *content.packs)
        TERRANE_TRY(addGenerators(pack, *content.blocks, until, content.generators));
    return content;
}

base::Result<void> addBlockNames(content::Language& language, const Content& content, std::string_view code) {
    for (const Pack& pack : *content.packs) {
        if (pack.info.name == kBuiltInPack) continue;  // those are in the language already
        const std::string wanted = fmt::format("languages/{}.toml", code);
        const std::string path = fileOf(pack, wanted) ? wanted : "languages/en.toml";
        const std::string* text = fileOf(pack, path);
        if (!text) continue;
        auto read = TERRANE_TRY(content::parseLanguage(*text, displayPath(pack, path)));
        for (auto& [name, shown] : read.blocks) language.blocks[qualifiedName(pack, name)] = std::move(shown);
    }
    return {};
}

}  // namespace terrane::pack
