#include "terrane/store/chunks/structure_file.h"

#include <xxhash.h>

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::store {
namespace {

namespace fs = std::filesystem;
using world::Structure;
using world::StructureBlock;

// "TerrStru" in little-endian byte order.
constexpr std::uint64_t kStructureMagic = 0x7572745372726554;
constexpr std::size_t kChecksumEnd = 2 * sizeof(std::uint64_t);  // the checksum covers everything after it
constexpr std::size_t kStructureHeaderBytes = kChecksumEnd + sizeof(std::uint8_t) + sizeof(std::uint32_t);
// A frame of incompressible data is slightly larger than the data.
constexpr std::size_t kMaxFileBytes = kMaxStructureBytes + (1u << 20);
constexpr std::string_view kEnding = ".structure";
constexpr std::size_t kMaxBlockNameBytes = 255;  // the length is one byte

auto damagedStructure(const std::string& what) {
    return base::fail(base::ErrorCode::Damaged, "{}", what);
}

bool isSize(int size) {
    return size >= 1 && size <= std::numeric_limits<std::uint16_t>::max();
}

// NAME, or PACK:NAME of a content pack.
bool isBlockName(std::string_view name) {
    const auto isPart = [](std::string_view part) {
        const auto isAllowed = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
        };
        return !part.empty() && std::ranges::all_of(part, isAllowed);
    };
    const std::size_t colon = name.find(':');
    const bool hasGoodPack = colon == std::string_view::npos || isPart(name.substr(0, colon));
    return name.size() <= kMaxBlockNameBytes && hasGoodPack && isPart(name.substr(colon + 1));
}

std::size_t dataBytes(const Structure& structure) {
    std::size_t bytes = 0;
    for (const world::StructureData& data : structure.data) bytes += data.data->size();
    return bytes;
}

base::Result<void> checkLimits(const Structure& s) {
    if (!isSize(s.size.x) || !isSize(s.size.y) || s.size.z < 1 || s.size.z > world::kMostLayers)
        return damagedStructure(
            fmt::format("{} × {} × {} blocks are not a structure", s.size.x, s.size.y, s.size.z));
    if (s.blockCount() > world::kMaxStructureBlocks)
        return damagedStructure(fmt::format("the structure has {} blocks, expected at most {}",
                                            s.blockCount(), world::kMaxStructureBlocks));
    return {};
}

// A cell is one byte, or two if the palette has more than 256 entries.
template <class Cell>
void appendCells(Bytes& out, const Structure& structure) {
    for (const std::uint32_t cell : structure.cells) appendNumber(out, static_cast<Cell>(cell));
}

Bytes structureContent(const Structure& structure) {
    Bytes out;
    out.reserve(structure.cells.size() * sizeof(std::uint16_t) + 4096);
    for (int axis = 0; axis < 3; ++axis) appendNumber(out, static_cast<std::uint16_t>(structure.size[axis]));
    appendNumber(out, static_cast<std::uint32_t>(structure.palette.size()));
    for (const StructureBlock& block : structure.palette) {
        appendNumber(out, static_cast<std::uint8_t>(block.name.size()));
        append(out, std::as_bytes(std::span(block.name)));
        appendNumber(out, block.state);
    }
    if (structure.palette.size() <= 256)
        appendCells<std::uint8_t>(out, structure);
    else
        appendCells<std::uint16_t>(out, structure);
    appendNumber(out, static_cast<std::uint32_t>(structure.data.size()));
    for (const world::StructureData& data : structure.data) {
        appendNumber(out, data.cell);
        appendNumber(out, static_cast<std::uint32_t>(data.data->size()));
        append(out, *data.data);
    }
    return out;
}

base::Result<void> readPalette(ByteReader& reader, Structure& structure) {
    const auto count = reader.number<std::uint32_t>();
    if (count > kMaxStructurePalette || count > structure.blockCount())
        return damagedStructure(fmt::format("the palette has {} entries", count));
    for (std::uint32_t n = 0; n < count && !reader.isPastEnd(); ++n) {
        const ByteView name = reader.take(reader.number<std::uint8_t>());
        StructureBlock block{.name = {reinterpret_cast<const char*>(name.data()), name.size()}};
        block.state = reader.number<std::uint16_t>();
        if (!reader.isPastEnd() && !isBlockName(block.name))
            return damagedStructure(fmt::format("{:?} is not a name of a block", block.name));
        structure.palette.push_back(std::move(block));
    }
    return {};
}

template <class Cell>
base::Result<void> readCells(ByteReader& reader, Structure& structure) {
    const auto count = static_cast<std::size_t>(structure.blockCount());
    ByteReader cells(reader.take(count * sizeof(Cell)));
    if (reader.isPastEnd()) return {};
    structure.cells.reserve(count);
    for (std::size_t n = 0; n < count; ++n) {
        const auto cell = cells.number<Cell>();
        if (cell >= structure.palette.size())
            return damagedStructure(
                fmt::format("a block has number {} of a palette of {}", cell, structure.palette.size()));
        structure.cells.push_back(cell);
    }
    return {};
}

base::Result<void> readData(ByteReader& reader, Structure& structure) {
    const auto count = reader.number<std::uint32_t>();
    std::int64_t last = -1;
    std::size_t bytes = 0;
    for (std::uint32_t n = 0; n < count && !reader.isPastEnd(); ++n) {
        const auto cell = reader.number<std::uint32_t>();
        const ByteView data = reader.take(reader.number<std::uint32_t>());
        if (reader.isPastEnd()) break;
        if (cell <= last || cell >= structure.blockCount())
            return damagedStructure("data of blocks is out of order");
        last = cell;
        bytes += data.size();
        if (bytes > kMaxStructureDataBytes)
            return damagedStructure(
                fmt::format("the blocks have more than {} bytes of data", kMaxStructureDataBytes));
        structure.data.push_back(
            {cell, std::make_shared<const world::BlockEntityData>(data.begin(), data.end())});
    }
    return {};
}

base::Result<Structure> readContent(ByteView bytes) {
    ByteReader reader(bytes);
    Structure structure;
    for (int axis = 0; axis < 3; ++axis) structure.size[axis] = reader.number<std::uint16_t>();
    if (reader.isPastEnd()) return damagedStructure("the structure ends too early");
    TERRANE_TRY(checkLimits(structure));
    TERRANE_TRY(readPalette(reader, structure));
    const bool isNarrow = structure.palette.size() <= 256;
    TERRANE_TRY(isNarrow ? readCells<std::uint8_t>(reader, structure)
                         : readCells<std::uint16_t>(reader, structure));
    TERRANE_TRY(readData(reader, structure));
    if (reader.isPastEnd()) return damagedStructure("the structure ends too early");
    if (!reader.rest().empty())
        return damagedStructure(fmt::format("{} bytes too many", reader.rest().size()));
    return structure;
}

}  // namespace

base::Result<Bytes> encodeStructure(const Structure& structure) {
    TERRANE_TRY(checkLimits(structure));
    if (structure.palette.size() > kMaxStructurePalette)
        return base::fail("the structure has {} different blocks, a file keeps at most {}",
                          structure.palette.size(), kMaxStructurePalette);
    if (const std::size_t bytes = dataBytes(structure); bytes > kMaxStructureDataBytes)
        return base::fail("the blocks have {} bytes of data, a file keeps at most {}", bytes,
                          kMaxStructureDataBytes);
    for (const StructureBlock& block : structure.palette)
        if (!isBlockName(block.name)) return base::fail("{:?} is not a name of a block", block.name);
    const Bytes plain = structureContent(structure);
    Bytes rest;
    appendNumber(rest, kStructureVersion);
    appendNumber(rest, static_cast<std::uint32_t>(plain.size()));
    appendCompressed(rest, plain);
    Bytes out;
    appendNumber(out, kStructureMagic);
    appendNumber(out, std::uint64_t{XXH64(rest.data(), rest.size(), 0)});
    append(out, rest);
    return out;
}

base::Result<Structure> decodeStructure(ByteView bytes, std::size_t maxBytes) {
    ByteReader reader(bytes);
    if (reader.number<std::uint64_t>() != kStructureMagic || bytes.size() < kStructureHeaderBytes)
        return base::fail(base::ErrorCode::BadInput, "it is not a structure");
    const ByteView rest = bytes.subspan(kChecksumEnd);
    if (reader.number<std::uint64_t>() != XXH64(rest.data(), rest.size(), 0))
        return damagedStructure("the checksum is wrong");
    if (const auto version = reader.number<std::uint8_t>(); version != kStructureVersion)
        return base::fail(base::ErrorCode::Incompatible, "structure version {}, expected {}", version,
                          kStructureVersion);
    const auto plainBytes = reader.number<std::uint32_t>();
    if (plainBytes > maxBytes)
        return damagedStructure(
            fmt::format("the structure says it has {} bytes, expected at most {}", plainBytes, maxBytes));
    Bytes plain(plainBytes);
    TERRANE_TRY(decompress(reader.rest(), plain));
    return readContent(plain);
}

base::Result<fs::path> structurePath(const fs::path& folder, std::string_view name) {
    if (!checkSaveName(name))
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: a name has 1 to {} bytes, neither slashes nor control characters, and no "
                          "dot or space in front",
                          name, kMaxSaveName);
    const fs::path path = folder / (std::string(name) + std::string(kEnding));
    std::error_code ignored;
    if (!fs::exists(path, ignored)) TERRANE_TRY(checkNewName(name));  // names that exist stay
    return path;
}

base::Result<void> writeStructure(const fs::path& file, const Structure& structure) {
    const auto bytes = encodeStructure(structure);
    if (!bytes) return base::fail(bytes.error().code, "{}: {}", file.string(), bytes.error().message);
    std::error_code ignored;  // writeFile() reports the error
    fs::create_directories(file.parent_path(), ignored);
    return base::writeFile(file, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

base::Result<Structure> readStructure(const fs::path& file) {
    const auto bytes = TERRANE_TRY(base::readFile(file, kMaxFileBytes));
    auto structure = decodeStructure(std::as_bytes(std::span(bytes)));
    if (!structure)
        return base::fail(structure.error().code, "{}: {}", file.string(), structure.error().message);
    return structure;
}

std::vector<std::string> structureNames(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const fs::path& path = it->path();
        if (path.extension() == kEnding && structurePath(folder, path.stem().string()))
            names.push_back(path.stem().string());
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace terrane::store
