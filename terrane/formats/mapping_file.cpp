// Reads the tables of block_mapping.h.
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include "terrane/base/embedded.h"
#include "terrane/base/files.h"
#include "terrane/formats/block_mapping.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> formats();
}  // namespace terrane::embedded

namespace terrane::formats {
namespace {

constexpr std::size_t kMaxMappingBytes = std::size_t{4} << 20;

std::optional<std::uint32_t> colorOf(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    std::uint32_t value = 0;
    const auto [end, bad] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (bad != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

base::Result<std::string_view> builtInFile(std::string_view name) {
    for (const base::EmbeddedFile& file : embedded::formats())
        if (file.path == name) return file.data;
    return base::fail("{}: not in the program", name);
}

}  // namespace

// Reads one file into a mapping; keeps the first error.
class BlockMapping::Reader {
  public:
    Reader(BlockMapping& mapping, const MappingFile& file) : mapping_(mapping), file_(file) {}

    base::Result<void> read() {
        toml::table table;
        try {
            table = toml::parse(file_.toml, file_.name);
        } catch (const toml::parse_error& error) {
            return base::fail(base::ErrorCode::BadInput, "{}:{}: {}", file_.name, error.source().begin.line,
                              error.description());
        }
        for (const auto& [key, value] : table) {
            if (key == "opposite")
                readOpposite(value);
            else if (key == "blocks" && value.is_table())
                readBlocks(*value.as_table());
            else if (key == "colors" && value.is_table())
                readColors(*value.as_table());
            else
                wrong(value, key.str(), "expected the list opposite, and the tables blocks and colors");
        }
        if (problem_) return tl::unexpected(*problem_);
        return {};
    }

  private:
    void wrong(const toml::node& node, std::string_view key, std::string_view what) {
        if (problem_) return;
        problem_ = base::Error{base::ErrorCode::BadInput,
                               fmt::format("{}:{}: {}: {}", file_.name, node.source().begin.line, key, what)};
    }

    const world::BlockType* typeOf(const toml::node& node, std::string_view key, std::string_view name) {
        const world::BlockType* type = mapping_.blocks_->find(name);
        if (!type) wrong(node, key, fmt::format("there is no block \"{}\"", name));
        return type;
    }

    void readOpposite(const toml::node& node) {
        if (!node.is_array()) return wrong(node, "opposite", "expected a list of blocks");
        for (const toml::node& value : *node.as_array()) {
            const world::BlockType* type = typeOf(value, "opposite", value.value_or(std::string_view()));
            if (type) mapping_.opposite_.push_back(type->id);
        }
    }

    // "torch", or "torch[8]" with a block state.
    void readBlocks(const toml::table& table) {
        for (const auto& [key, names] : table) {
            const std::string_view text = key.str(), name = text.substr(0, text.find('['));
            const world::BlockType* type = typeOf(names, text, name);
            std::uint16_t state = 0;
            if (name != text) {
                const char *begin = text.data() + name.size() + 1, *end = text.data() + text.size() - 1;
                const auto [after, bad] = std::from_chars(begin, std::max(begin, end), state);
                if (bad != std::errc() || after != end || *end != ']')
                    wrong(names, text, "expected a block state as NAME[0] to NAME[65535]");
            }
            if (!names.is_array()) wrong(names, text, "expected a list of names");
            if (problem_) return;
            for (const toml::node& value : *names.as_array()) addName(value, text, {type->id, state});
        }
    }

    void addName(const toml::node& value, std::string_view key, BlockAndState block) {
        auto name = namedState(value.value_or(std::string_view()));
        if (!name) return wrong(value, key, "expected a name, \"oak_slab[type=double]\"");
        const std::size_t number = mapping_.entries_.size();
        mapping_.byName_[name->name].push_back(number);
        mapping_.byBlock_[block.id].push_back(number);
        mapping_.entries_.push_back({std::move(*name), block});
    }

    void readColors(const toml::table& table) {
        for (const auto& [key, value] : table) {
            const auto color = colorOf(key.str());
            if (!color) return wrong(value, key.str(), "expected a color as \"#rrggbb\"");
            const world::BlockType* type = typeOf(value, key.str(), value.value_or(std::string_view()));
            if (type) mapping_.colors_[*color] = type->id;
        }
    }

    BlockMapping& mapping_;
    const MappingFile& file_;
    std::optional<base::Error> problem_;
};

base::Result<BlockMapping> BlockMapping::create(const world::BlockRegistry& blocks,
                                                std::span<const MappingFile> files) {
    BlockMapping mapping(blocks);
    for (const MappingFile& file : files) TERRANE_TRY(Reader(mapping, file).read());
    return mapping;
}

base::Result<BlockMapping> loadMapping(const world::BlockRegistry& blocks, const std::string& file) {
    const auto builtIn = TERRANE_TRY(builtInFile("minecraft.toml"));
    std::vector<MappingFile> files{{builtIn, "minecraft.toml"}};
    base::Result<std::string> text;
    if (!file.empty()) {
        text = base::readFile(file, kMaxMappingBytes);
        if (!text) return tl::unexpected(text.error());
        files.push_back({*text, file});
    }
    return BlockMapping::create(blocks, files);
}

base::Result<LegacyIds> builtInLegacyIds() {
    const auto text = TERRANE_TRY(builtInFile("minecraft_ids.toml"));
    return LegacyIds::parse(text, "minecraft_ids.toml");
}

}  // namespace terrane::formats
