#include "terrane/formats/minecraft_chunk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace terrane::formats {

namespace {

// Since snapshot 20w17a (1.16) no index crosses from one 64-bit word into the next.
constexpr int kAlignedSince = 2529;
constexpr unsigned kLeastIndexBits = 4;
// A chunk has 24 sections; worlds may be up to 4,064 blocks high.
constexpr std::size_t kMaxAnvilSections = 256;
constexpr std::size_t kNibbleBytes = kAnvilSectionBlocks / 2;

constexpr std::array<std::string_view, 6> kFinishedStatus{
    "full", "minecraft:full", "fullchunk", "postprocessed", "mobs_spawned", "minecraft:mobs_spawned"};

tl::unexpected<base::Error> damaged(std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "{}", what);
}

std::optional<NamedState> stateOf(const NbtTag& tag) {
    const auto* compound = std::get_if<NbtCompound>(&tag.value);
    const std::string* name = compound ? compound->get<std::string>("Name") : nullptr;
    if (!name || name->empty()) return std::nullopt;
    NamedState state{*name, {}};
    if (const auto* properties = compound->get<NbtCompound>("Properties")) {
        for (const NbtEntry& entry : properties->entries)
            if (const auto* value = std::get_if<std::string>(&entry.tag.value)) state.set(entry.name, *value);
    }
    return state;
}

// Unpacks 4,096 indices of as many bits as the palette needs, at least 4.
base::Result<std::vector<std::uint16_t>> unpacked(const std::vector<std::int64_t>& words,
                                                  std::size_t paletteSize, bool isAligned) {
    const unsigned bits = std::max(kLeastIndexBits, static_cast<unsigned>(std::bit_width(paletteSize - 1)));
    const std::size_t inWord = 64 / bits;
    const std::size_t needed = isAligned ? (kAnvilSectionBlocks + inWord - 1) / inWord
                                         : std::size_t{kAnvilSectionBlocks} * bits / 64;
    if (words.size() < needed) return damaged("a section has too few indices");
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const auto word = [&](std::size_t k) { return static_cast<std::uint64_t>(words[k]); };
    std::vector<std::uint16_t> blocks(kAnvilSectionBlocks);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        const std::size_t bit = isAligned ? k / inWord * 64 + k % inWord * bits : k * bits;
        std::uint64_t value = word(bit / 64) >> bit % 64;
        if (bit % 64 + bits > 64) value |= word(bit / 64 + 1) << (64 - bit % 64);
        value &= mask;
        if (value >= paletteSize) return damaged("a block has no entry in its section's palette");
        blocks[k] = static_cast<std::uint16_t>(value);
    }
    return blocks;
}

// `words` is null if all blocks are the first palette entry.
base::Result<AnvilSection> sectionOf(int y, const NbtList& palette, const std::vector<std::int64_t>* words,
                                     bool isAligned) {
    AnvilSection section;
    section.y = y;
    if (palette.tags.empty() || palette.tags.size() > kAnvilSectionBlocks)
        return damaged("a section's palette is empty, or too long");
    for (const NbtTag& tag : palette.tags) {
        auto state = stateOf(tag);
        if (!state) return damaged("an entry of a section's palette has no name");
        section.palette.push_back(std::move(*state));
    }
    if (!words || words->empty()) {
        if (section.palette.size() > 1) return damaged("a section has no indices");
        return section;
    }
    auto blocks = TERRANE_TRY(unpacked(*words, section.palette.size(), isAligned));
    section.blocks = std::move(blocks);
    return section;
}

int nibbleOf(const std::string& nibbles, std::size_t k) {
    const auto both = static_cast<std::uint8_t>(nibbles[k / 2]);
    return k % 2 == 0 ? both & 15 : both >> 4;
}

// A section with numbers: ids in bytes, four more bits of ids in `Add`, and four bits of data.
base::Result<AnvilSection> numberedSection(int y, const NbtCompound& tag, const LegacyIds& ids) {
    const auto* low = tag.get<NbtBytes>("Blocks");
    const auto* data = tag.get<NbtBytes>("Data");
    const auto* high = tag.get<NbtBytes>("Add");
    if (!low || low->bytes.size() < kAnvilSectionBlocks || !data || data->bytes.size() < kNibbleBytes ||
        (high && high->bytes.size() < kNibbleBytes))
        return damaged("a section has too few blocks");
    AnvilSection section;
    section.y = y;
    section.blocks.resize(kAnvilSectionBlocks);
    std::vector<std::uint16_t> entryOf(std::size_t{1} << 16, UINT16_MAX);
    for (std::size_t k = 0; k < section.blocks.size(); ++k) {
        const int id = static_cast<std::uint8_t>(low->bytes[k]) | (high ? nibbleOf(high->bytes, k) << 8 : 0);
        const int bits = nibbleOf(data->bytes, k);
        std::uint16_t& entry = entryOf[static_cast<std::size_t>(id << 4 | bits)];
        if (entry == UINT16_MAX) {
            entry = static_cast<std::uint16_t>(section.palette.size());
            section.palette.push_back(ids.stateOf(id, bits));
        }
        section.blocks[k] = entry;
    }
    return section;
}

// Nothing for a section that has only light.
base::Result<std::optional<AnvilSection>> readSection(const NbtTag& tag, int dataVersion,
                                                      const LegacyIds& ids) {
    const auto* compound = std::get_if<NbtCompound>(&tag.value);
    if (!compound) return damaged("a section is no compound");
    const auto y = compound->integer("Y");
    if (!y || *y < INT8_MIN || *y > INT8_MAX) return damaged("a section has no height");
    const auto wrap = [](base::Result<AnvilSection> section) -> base::Result<std::optional<AnvilSection>> {
        if (!section) return tl::unexpected(section.error());
        return std::optional<AnvilSection>(std::move(*section));
    };
    const int height = static_cast<int>(*y);
    if (const auto* states = compound->get<NbtCompound>("block_states")) {
        const auto* palette = states->get<NbtList>("palette");
        if (!palette) return damaged("a section has no palette");
        return wrap(sectionOf(height, *palette, states->get<std::vector<std::int64_t>>("data"), true));
    }
    if (const auto* palette = compound->get<NbtList>("Palette")) {
        const auto* words = compound->get<std::vector<std::int64_t>>("BlockStates");
        return wrap(sectionOf(height, *palette, words, dataVersion >= kAlignedSince));
    }
    if (compound->find("Blocks")) return wrap(numberedSection(height, *compound, ids));
    return std::optional<AnvilSection>();
}

void countBlockEntities(const NbtCompound& chunk, AnvilChunk& result) {
    const auto* list = chunk.get<NbtList>("block_entities");
    if (!list) list = chunk.get<NbtList>("TileEntities");
    if (!list) return;
    for (const NbtTag& tag : list->tags) {
        const auto* entity = std::get_if<NbtCompound>(&tag.value);
        const std::string* id = entity ? entity->get<std::string>("id") : nullptr;
        if (id) ++result.blockEntities[*id];
    }
}

}  // namespace

base::Result<AnvilChunk> decodeAnvilChunk(const NbtCompound& root, const LegacyIds& ids) {
    // Up to 1.17 everything but the version is in "Level".
    const auto* level = root.get<NbtCompound>("Level");
    const NbtCompound& chunk = level ? *level : root;
    const auto x = chunk.integer("xPos"), z = chunk.integer("zPos");
    if (!x || !z || *x != static_cast<std::int32_t>(*x) || *z != static_cast<std::int32_t>(*z))
        return damaged("the chunk has no position");
    AnvilChunk result;
    result.x = static_cast<std::int32_t>(*x);
    result.z = static_cast<std::int32_t>(*z);
    const std::int64_t version = root.integer("DataVersion").value_or(0);
    result.dataVersion = static_cast<int>(std::clamp<std::int64_t>(version, 0, INT32_MAX));
    if (const auto* status = chunk.get<std::string>("Status"))
        result.isFinished = std::ranges::find(kFinishedStatus, *status) != kFinishedStatus.end();
    const auto* sections = chunk.get<NbtList>(level ? "Sections" : "sections");
    if (sections && sections->tags.size() > kMaxAnvilSections)
        return damaged("the chunk has too many sections");
    for (const NbtTag& tag : sections ? std::span<const NbtTag>(sections->tags) : std::span<const NbtTag>()) {
        auto section = TERRANE_TRY(readSection(tag, result.dataVersion, ids));
        if (section) result.sections.push_back(std::move(*section));
    }
    countBlockEntities(chunk, result);
    return result;
}

std::optional<SectionRange> sectionRangeOf(const NbtCompound& root) {
    const auto* level = root.get<NbtCompound>("Level");
    const auto* sections = (level ? *level : root).get<NbtList>(level ? "Sections" : "sections");
    std::optional<SectionRange> range;
    for (const NbtTag& tag : sections ? std::span<const NbtTag>(sections->tags) : std::span<const NbtTag>()) {
        const auto* compound = std::get_if<NbtCompound>(&tag.value);
        const auto y = compound ? compound->integer("Y") : std::nullopt;
        if (!y || *y < INT8_MIN || *y > INT8_MAX) continue;
        if (!compound->find("block_states") && !compound->find("Palette") && !compound->find("Blocks"))
            continue;
        const int number = static_cast<int>(*y);
        if (!range) range = {number, number};
        range = {std::min(range->lowest, number), std::max(range->highest, number)};
    }
    return range;
}

namespace {

constexpr int kSide = world::kChunkSize;
// Data version of snapshot 17w47a: from then on the upper half of a door has its facing, too.
constexpr int kNamesSince = 1451;

using SectionValues = std::array<world::Section::Value, world::kBlocksPerSection>;

// The blocks and states of a chunk: 16 KiB for each section that has some.
class ChunkValues {
  public:
    explicit ChunkValues(world::Heights heights)
        : heights_(heights), sections_(static_cast<std::size_t>(heights.sections())) {}

    struct Sections {
        SectionValues ids{}, states{};
    };
    world::Heights heights() const { return heights_; }
    // Null if the section has no blocks; its number is one of the heights.
    Sections* find(int number) { return sections_[place(number)].get(); }
    Sections& at(int number) {
        auto& section = sections_[place(number)];
        if (!section) section = std::make_unique<Sections>();
        return *section;
    }

  private:
    std::size_t place(int number) const { return static_cast<std::size_t>(number - heights_.firstSection()); }

    world::Heights heights_;
    std::vector<std::unique_ptr<Sections>> sections_;
};

// Blocks of a section's palette entries, each looked up once.
std::vector<BlockAndState> mappedPalette(const AnvilSection& section, const BlockMapping& mapping) {
    std::vector<BlockAndState> blocks;
    for (const NamedState& state : section.palette) blocks.push_back(mapping.blockOf(state));
    return blocks;
}

void countBlocks(const AnvilSection& section, const BlockMapping& mapping, ImportCounts& counts) {
    std::vector<std::uint64_t> uses(section.palette.size());
    if (section.blocks.empty()) uses[0] = kAnvilSectionBlocks;
    for (const std::uint16_t entry : section.blocks) ++uses[entry];
    addUses(section.palette, uses, mapping, counts);
}

// Our x is Minecraft's -x: the blocks of a row are in reverse order.
void putSection(const AnvilSection& section, std::span<const BlockAndState> palette, int shift,
                ChunkValues& values, ImportCounts& counts) {
    const world::Heights heights = values.heights();
    for (int k = 0; k < kAnvilSectionBlocks; ++k) {
        const BlockAndState block =
            palette[section.blocks.empty() ? 0 : section.blocks[static_cast<std::size_t>(k)]];
        if (block.id == world::kAir) continue;
        const int z = section.y * kSide + k / (kSide * kSide) + shift;
        if (!heights.contains(z)) {
            ++(z < heights.bottom ? counts.below : counts.above);
            continue;
        }
        const world::BlockIndex at = world::blockIndex(kSide - 1 - k % kSide, k / kSide % kSide, z);
        const auto inSection = static_cast<std::size_t>(world::indexInSection(at));
        ChunkValues::Sections& target = values.at(world::sectionOf(at));
        target.ids[inSection] = block.id;
        target.states[inSection] = block.state;
    }
}

// Up to 1.12 only the lower half of a door stores where it faces and whether it is open: copies that to the
// upper half.
void completeDoors(world::BlockId door, world::BlockId top, ChunkValues& values) {
    constexpr std::size_t kLayer = kSide * kSide;
    for (int number = values.heights().firstSection(); number < values.heights().endSection(); ++number) {
        ChunkValues::Sections* upper = values.find(number);
        if (!upper) continue;
        for (std::size_t k = 0; k < upper->ids.size(); ++k) {
            if (upper->ids[k] != top) continue;
            const bool isLowest = k < kLayer;
            const bool hasBelow = !isLowest || number > values.heights().firstSection();
            const ChunkValues::Sections* lower = !hasBelow  ? nullptr
                                                 : isLowest ? values.find(number - 1)
                                                            : upper;
            const std::size_t below = isLowest ? k + upper->ids.size() - kLayer : k - kLayer;
            if (lower && lower->ids[below] == door) upper->states[k] = lower->states[below];
        }
    }
}

world::Chunk chunkFrom(ChunkValues& values) {
    world::Chunk chunk(values.heights());
    for (int number = values.heights().firstSection(); number < values.heights().endSection(); ++number) {
        const ChunkValues::Sections* section = values.find(number);
        if (!section) continue;
        chunk.setSection(number, world::Section::fromValues(section->ids));
        chunk.setBlockStateSection(number, world::Section::fromValues(section->states));
    }
    return chunk;
}

}  // namespace

world::ChunkPos chunkPosOf(const AnvilChunk& chunk) {
    return {-1 - chunk.x, chunk.z};
}

void addUses(std::span<const NamedState> palette, std::span<const std::uint64_t> uses,
             const BlockMapping& mapping, ImportCounts& counts) {
    for (std::size_t k = 0; k < uses.size(); ++k) {
        if (uses[k] == 0) continue;
        counts.blocks[palette[k].name] += uses[k];
        if (!mapping.isKnown(palette[k])) counts.unknown[textOf(palette[k])] += uses[k];
    }
}

world::Chunk toChunk(const AnvilChunk& chunk, const BlockMapping& mapping, const AnvilPlacement& placement,
                     ImportCounts& counts) {
    ChunkValues values(placement.heights);
    for (const AnvilSection& section : chunk.sections) {
        countBlocks(section, mapping, counts);
        putSection(section, mappedPalette(section, mapping), placement.shift, values, counts);
    }
    for (const auto& [kind, count] : chunk.blockEntities)
        counts.blockEntities[kind] += static_cast<std::uint64_t>(count);
    if (chunk.dataVersion < kNamesSince) {
        for (const auto& [door, top] : mapping.doors()) completeDoors(door, top, values);
    }
    return chunkFrom(values);
}

}  // namespace terrane::formats
