#include "terrane/formats/schematic.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "terrane/formats/nbt.h"

namespace terrane::formats {
namespace {

constexpr std::int64_t kMaxSide = 65535;
constexpr std::size_t kMaxSchematicPalette = 65536;
// Minecraft 1.20.1, whose names are written; newer readers rename blocks that have other names now.
constexpr std::int32_t kWrittenDataVersion = 3465;

tl::unexpected<base::Error> damagedSchematic(std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "schematic: {}", what);
}

// The file's index of a cell is x + z · width + y · width · length; ours differs only in the order of a row.
std::size_t cellOfFileIndex(std::size_t index, glm::ivec3 size) {
    const auto sizeX = static_cast<std::size_t>(size.x), sizeY = static_cast<std::size_t>(size.y);
    const std::size_t x = index % sizeX, row = index / sizeX % sizeY, z = index / sizeX / sizeY;
    return sizeX - 1 - x + sizeX * (row + sizeY * z);
}

// Sides are unsigned 16-bit numbers in a signed type.
base::Result<glm::ivec3> sizeOf(const NbtCompound& schematic) {
    std::array<std::int64_t, 3> sides{};
    constexpr std::array<std::string_view, 3> kNames{"Width", "Length", "Height"};
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const auto side = schematic.integer(kNames[k]);
        if (!side) return damagedSchematic("its size is missing");
        sides[k] = *side & kMaxSide;
    }
    TERRANE_TRY(checkVolumeSize(sides[0], sides[1], sides[2]));
    return glm::ivec3(sides[0], sides[1], sides[2]);
}

// Reads numbers of 7 bits a byte, the lowest first.
base::Result<std::vector<std::uint32_t>> readVarints(std::string_view bytes, std::size_t count) {
    std::vector<std::uint32_t> values;
    values.reserve(std::min(count, bytes.size()));
    std::size_t at = 0;
    while (values.size() < count) {
        std::uint32_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            if (at == bytes.size() || shift > 28) return damagedSchematic("it has too few blocks");
            const auto byte = static_cast<std::uint8_t>(bytes[at++]);
            value |= (byte & 127u) << shift;
            if (byte < 128) break;
        }
        values.push_back(value);
    }
    return values;
}

// Adds the names to the volume's palette; returns their indices by the file's numbers, which need not be
// dense.
base::Result<std::unordered_map<std::uint32_t, std::uint16_t>> readPalette(const NbtCompound& palette,
                                                                           NamedVolume& volume) {
    std::unordered_map<std::uint32_t, std::uint16_t> entries;
    for (const NbtEntry& entry : palette.entries) {
        const auto* number = std::get_if<std::int32_t>(&entry.tag.value);
        auto state = namedState(entry.name);
        if (!number || *number < 0 || !state) return damagedSchematic("an entry of its palette is wrong");
        if (volume.palette.size() == kMaxSchematicPalette) return damagedSchematic("its palette is too long");
        entries[static_cast<std::uint32_t>(*number)] = static_cast<std::uint16_t>(volume.palette.size());
        volume.palette.push_back(std::move(*state));
    }
    return entries;
}

base::Result<NamedVolume> readSponge(const NbtCompound& schematic, const NbtCompound& palette,
                                     const NbtBytes& data) {
    const auto size = TERRANE_TRY(sizeOf(schematic));
    NamedVolume volume{size, {}, {}};
    const auto entries = TERRANE_TRY(readPalette(palette, volume));
    const auto count = static_cast<std::size_t>(std::int64_t{size.x} * size.y * size.z);
    if (data.bytes.size() < count) return damagedSchematic("it has too few blocks");
    const auto numbers = TERRANE_TRY(readVarints(data.bytes, count));
    volume.cells.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        const auto entry = entries.find(numbers[k]);
        if (entry == entries.end()) return damagedSchematic("a block has no entry in its palette");
        volume.cells[cellOfFileIndex(k, size)] = entry->second;
    }
    return volume;
}

// MCEdit's format: a byte of id and one of data for each block, four more bits of ids in AddBlocks.
base::Result<NamedVolume> readNumbered(const NbtCompound& schematic, const LegacyIds& ids) {
    const auto size = TERRANE_TRY(sizeOf(schematic));
    const auto* low = schematic.get<NbtBytes>("Blocks");
    const auto* data = schematic.get<NbtBytes>("Data");
    const auto* high = schematic.get<NbtBytes>("AddBlocks");
    NamedVolume volume{size, {}, {}};
    const auto count = static_cast<std::size_t>(std::int64_t{size.x} * size.y * size.z);
    if (!data || low->bytes.size() < count || data->bytes.size() < count ||
        (high && high->bytes.size() < (count + 1) / 2))
        return damagedSchematic("it has too few blocks");
    volume.cells.resize(count);
    std::vector<std::int32_t> entryOf(kMaxSchematicPalette, -1);
    for (std::size_t k = 0; k < count; ++k) {
        // The first of two blocks has the upper four bits, unlike in chunks.
        const int more =
            high ? static_cast<std::uint8_t>(high->bytes[k / 2]) >> (k % 2 == 0 ? 4 : 0) & 15 : 0;
        const int id = static_cast<std::uint8_t>(low->bytes[k]) | more << 8, bits = data->bytes[k] & 15;
        std::int32_t& entry = entryOf[static_cast<std::size_t>(id << 4 | bits)];
        if (entry < 0) {
            entry = static_cast<std::int32_t>(volume.palette.size());
            volume.palette.push_back(ids.stateOf(id, bits));
        }
        volume.cells[cellOfFileIndex(k, size)] = static_cast<std::uint16_t>(entry);
    }
    return volume;
}

void appendVarint(std::string& bytes, std::uint32_t value) {
    for (; value >= 128; value >>= 7) bytes.push_back(static_cast<char>(value | 128));
    bytes.push_back(static_cast<char>(value));
}

}  // namespace

base::Result<NamedVolume> decodeSchematic(std::string_view bytes, const LegacyIds& ids) {
    const auto nbt = inflate(bytes, kMaxSchematicBytes);
    if (!nbt) return base::fail(nbt.error().code, "schematic: {}", nbt.error().message);
    const auto root = TERRANE_TRY(decodeNbt(*nbt));
    // Version 3 has an outer compound without name.
    const auto* inner = root.compound.get<NbtCompound>("Schematic");
    const NbtCompound& schematic = inner ? *inner : root.compound;
    if (schematic.get<NbtBytes>("Blocks")) return readNumbered(schematic, ids);
    const auto version = schematic.integer("Version");
    if (!version) return damagedSchematic("it has no version: not a schematic");
    if (*version < 1 || *version > 3)
        return base::fail(base::ErrorCode::Unsupported, "schematic: version {} is not supported, only 1 to 3",
                          *version);
    const auto* blocks = schematic.get<NbtCompound>("Blocks");
    const NbtCompound& holder = *version == 3 && blocks ? *blocks : schematic;
    const auto* palette = holder.get<NbtCompound>("Palette");
    const auto* data = holder.get<NbtBytes>(*version == 3 ? "Data" : "BlockData");
    if (!palette || !data) return damagedSchematic("its blocks are missing");
    return readSponge(schematic, *palette, *data);
}

base::Result<std::string> encodeSchematic(const NamedVolume& volume) {
    const glm::ivec3 size = volume.size;
    if (std::max({size.x, size.y, size.z}) > kMaxSide)
        return base::fail(base::ErrorCode::BadInput, "a schematic has at most {} blocks per side", kMaxSide);
    // Palette entries are numbered in the order of the file, so that equal boxes give equal files.
    NbtCompound palette;
    std::unordered_map<std::string, std::int32_t> numbers;  // entries may have the same name
    std::vector<std::int32_t> numberOf(volume.palette.size(), -1);
    std::string data;
    for (std::size_t k = 0; k < volume.cells.size(); ++k) {
        const std::uint16_t cell = volume.cells[cellOfFileIndex(k, size)];
        if (numberOf[cell] < 0) {
            const auto next = static_cast<std::int32_t>(numbers.size());
            const auto [place, isNew] = numbers.emplace(textOf(volume.palette[cell]), next);
            if (isNew) palette.add(place->first, {place->second});
            numberOf[cell] = place->second;
        }
        appendVarint(data, static_cast<std::uint32_t>(numberOf[cell]));
    }
    const auto side = [](int blocks) { return NbtTag{static_cast<std::int16_t>(blocks)}; };
    NbtRoot root{"Schematic", {}};
    root.compound.add("Version", {std::int32_t{2}}).add("DataVersion", {kWrittenDataVersion});
    root.compound.add("Width", side(size.x)).add("Height", side(size.z)).add("Length", side(size.y));
    root.compound.add("Offset", {std::vector<std::int32_t>(3)});
    root.compound.add("PaletteMax", {static_cast<std::int32_t>(numbers.size())}).add("Palette", {palette});
    root.compound.add("BlockData", {NbtBytes{std::move(data)}});
    root.compound.add("BlockEntities", {NbtList{}});
    return gzip(encodeNbt(root));
}

}  // namespace terrane::formats
