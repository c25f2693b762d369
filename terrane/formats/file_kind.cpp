#include "terrane/formats/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "terrane/formats/nbt.h"
#include "terrane/formats/region_file.h"

namespace terrane::formats {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr std::string_view kPasteIt =
    "paste it into a world of Minecraft (Java Edition) and import the world, or save it there as .schem with "
    "WorldEdit";
constexpr std::string_view kConvertBedrock =
    "convert the world to Java Edition, for example with Chunker or Amulet, and import its folder";
constexpr std::string_view kCanBeImported =
    "worlds of Minecraft (Java Edition), schematics (.schem, .schematic) and models (.vox) can be imported";
constexpr std::string_view kConvertToVox = "convert it to .vox, which can be imported";
constexpr std::string_view kSaveWithMcedit = "save it as .schematic with MCEdit, which can be imported";
constexpr std::string_view kUnpack = "unpack it and import what it holds";

// Read by `terrane import FORMAT`.
constexpr FileKind importable(std::string_view name, std::string_view format) {
    return {name, format, {}};
}
// Read by no import.
constexpr FileKind foreign(std::string_view name, std::string_view advice) {
    return {name, {}, advice};
}

constexpr FileKind kJavaWorld = importable("a world of Minecraft (Java Edition)", "minecraft");
constexpr FileKind kJavaRegion = importable("a region file of Minecraft (.mca)", "minecraft");
constexpr FileKind kSchematic = importable("a schematic of Sponge or MCEdit", "schem");
constexpr FileKind kVoxModel = importable("a model of MagicaVoxel", "vox");

constexpr FileKind kEmptyFile = foreign("an empty file", "get the file again");
constexpr FileKind kWebPage = foreign("a web page", "download the file itself");
constexpr FileKind kLuantiSchematic = foreign("a schematic of Luanti (.mts)", kCanBeImported);
constexpr FileKind kLuantiWorld = foreign("a world of Luanti", kCanBeImported);
constexpr FileKind kBedrockArchive =
    foreign("a world of Minecraft Bedrock Edition (.mcworld)", kConvertBedrock);
constexpr FileKind kBedrockWorld = foreign("a world of Minecraft Bedrock Edition", kConvertBedrock);
constexpr FileKind kBedrockStructure =
    foreign("a structure of Minecraft Bedrock Edition (.mcstructure)", kConvertBedrock);
constexpr FileKind kBedrockLevel =
    foreign("the file level.dat of a world of Minecraft Bedrock Edition", kConvertBedrock);
constexpr FileKind kBetaRegion = foreign("a region file of Minecraft Beta 1.3 to 1.1 (.mcr)",
                                         "open its world once in Minecraft 1.12 and import the folder");
constexpr FileKind kBetaWorld = foreign("a world of Minecraft Beta 1.3 to 1.1 (.mcr files)",
                                        "open it once in Minecraft 1.12, which converts it");
constexpr FileKind kAlphaWorld =
    foreign("a world of Minecraft Alpha", "open it once in Minecraft 1.0 and once in 1.12, which convert it");
constexpr FileKind kIndevLevel = foreign("a level of Minecraft Indev (.mclevel)", kSaveWithMcedit);
constexpr FileKind kClassicLevel = foreign("a level of Minecraft Classic", kSaveWithMcedit);
constexpr FileKind kClassicWorld =
    foreign("a level of Minecraft Classic (ClassicWorld, .cw)", kSaveWithMcedit);
constexpr FileKind kLitematic = foreign("a schematic of Litematica (.litematic)", kPasteIt);
constexpr FileKind kJavaStructure = foreign("a structure file of Minecraft (.nbt)", kPasteIt);
constexpr FileKind kLevelFile = foreign("the file level.dat of a world of Minecraft",
                                        "import the folder that it is in with `terrane import minecraft`");
constexpr FileKind kNbtFile =
    foreign("a data file of Minecraft (NBT) without blocks", "import the folder of its world");
constexpr FileKind kQubicle = foreign("a model of Qubicle", kConvertToVox);
constexpr FileKind kGoxel = foreign("a model of Goxel (.gox)", kConvertToVox);
constexpr FileKind kMesh = foreign("a mesh (glTF or OBJ) without blocks",
                                   "turn it into voxels first and save them as .vox, which can be imported");
constexpr FileKind kImage = foreign("an image without blocks", kCanBeImported);
constexpr FileKind kNumpy = foreign("an array of NumPy", kCanBeImported);
constexpr FileKind kTerraneStructure =
    foreign("a structure of Terrane", "it needs no import: the selection tool pastes it");
constexpr FileKind kSqlite =
    foreign("a SQLite database, as of a world of Terrane or Luanti", "a world of Terrane opens with --world");
constexpr FileKind kZip = foreign("a zip archive", kUnpack);
constexpr FileKind k7z = foreign("a 7z archive", kUnpack);
constexpr FileKind kRar = foreign("a RAR archive", kUnpack);
constexpr FileKind kTar = foreign("a tar archive", kUnpack);
constexpr FileKind kXz = foreign("an xz archive", kUnpack);
constexpr FileKind kZstd = foreign("a zstd archive", kUnpack);
constexpr FileKind kGzipFile = foreign("a gzip archive of something else", kUnpack);

struct Magic {
    std::size_t at;  // in bytes
    std::string_view bytes;
    const FileKind* kind;
};

constexpr auto kMagics = std::to_array<Magic>({
    {0, "MTSM"sv, &kLuantiSchematic},
    {0, "VOX "sv, &kVoxModel},
    {0, "QB 2"sv, &kQubicle},
    {0, "QBCL"sv, &kQubicle},
    {0, "GOX "sv, &kGoxel},
    {0, "glTF"sv, &kMesh},
    {0, "\x89PNG\r\n\x1a\n"sv, &kImage},
    {0, "\xff\xd8\xff"sv, &kImage},  // JPEG
    {0, "7z\xbc\xaf\x27\x1c"sv, &k7z},
    {0, "Rar!\x1a\x07"sv, &kRar},
    {0,
     "\xfd"
     "7zXZ\0"sv,
     &kXz},
    {0, "\x28\xb5\x2f\xfd"sv, &kZstd},
    {257, "ustar"sv, &kTar},
    {0, "SQLite format 3\0"sv, &kSqlite},
    {0, "TerrStru"sv, &kTerraneStructure},
    {0, "\x93NUMPY"sv, &kNumpy},
    {0, "\x27\x1b\xb7\x88"sv, &kClassicLevel},
});

bool hasAt(std::string_view bytes, std::size_t at, std::string_view wanted) {
    return bytes.size() >= at && bytes.substr(at).starts_with(wanted);
}

bool contains(std::string_view bytes, std::string_view wanted) {
    return bytes.find(wanted) != std::string_view::npos;
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

std::uint32_t littleEndian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    return value;
}

// The names at the top of NBT data that may be cut off anywhere. Payloads are skipped, not decoded.
class NbtNames {
  public:
    explicit NbtNames(std::string_view bytes) : bytes_(bytes) {
        if (number(1) != kCompound) return;
        root_ = text();
        isNbt_ = !isAtEnd_;
        while (!isAtEnd_) {
            const auto type = static_cast<std::uint8_t>(number(1));
            if (type == 0 || isAtEnd_) return;
            if (type > kLongArray) isNbt_ = false;
            const std::string_view name = text();
            if (isAtEnd_ || !isNbt_) return;
            names_.push_back(name);
            skip(type, 1);
        }
    }

    bool isNbt() const { return isNbt_ && !names_.empty(); }
    std::string_view root() const { return root_; }
    bool has(std::string_view name) const { return std::ranges::find(names_, name) != names_.end(); }

  private:
    enum Type : std::uint8_t { kByteArray = 7, kText, kList, kCompound, kIntArray, kLongArray };
    static constexpr std::array<std::size_t, 7> kNumberBytes{0, 1, 2, 4, 8, 4, 8};

    std::uint64_t number(std::size_t bytes) {
        if (bytes_.size() - at_ < bytes) isAtEnd_ = true;
        if (isAtEnd_) return 0;
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < bytes; ++k) value = value << 8 | static_cast<std::uint8_t>(bytes_[at_++]);
        return value;
    }
    void skipBytes(std::uint64_t count) {
        if (count > bytes_.size() - at_)
            isAtEnd_ = true;
        else
            at_ += static_cast<std::size_t>(count);
    }
    std::string_view text() {
        const std::uint64_t size = number(2);
        const std::size_t start = at_;
        skipBytes(size);
        return isAtEnd_ ? std::string_view() : bytes_.substr(start, static_cast<std::size_t>(size));
    }
    // Each call takes at least a byte or ends, so that hostile lengths cost nothing.
    void skip(std::uint8_t type, int depth) {
        if (depth >= kMaxNbtDepth || type > kLongArray) isAtEnd_ = true;
        if (isAtEnd_) return;
        if (type < kNumberBytes.size()) return skipBytes(kNumberBytes[type]);
        if (type == kText) return skipBytes(number(2));
        if (type == kCompound) return skipCompound(depth);
        if (type == kList) {
            const auto of = static_cast<std::uint8_t>(number(1));
            const std::uint64_t count = number(4);
            if (of < kNumberBytes.size()) return skipBytes(count * kNumberBytes[of]);
            for (std::uint64_t k = 0; k < count && !isAtEnd_; ++k) skip(of, depth + 1);
            return;
        }
        skipBytes(number(4) * (type == kByteArray ? 1u : type == kIntArray ? 4u : 8u));
    }
    void skipCompound(int depth) {
        while (!isAtEnd_) {
            const auto type = static_cast<std::uint8_t>(number(1));
            if (type == 0 || isAtEnd_) return;
            (void)text();
            skip(type, depth + 1);
        }
    }

    std::string_view bytes_, root_;
    std::size_t at_ = 0;
    bool isAtEnd_ = false, isNbt_ = false;
    std::vector<std::string_view> names_;
};

const FileKind* kindOfNbt(std::string_view bytes) {
    const NbtNames names(bytes);
    if (!names.isNbt()) return nullptr;
    if (names.root() == "ClassicWorld") return &kClassicWorld;
    if (names.root() == "MinecraftLevel") return &kIndevLevel;
    const bool isSchematic = names.root() == "Schematic" || names.has("Schematic") ||
                             names.has("BlockData") || (names.has("Blocks") && names.has("Materials"));
    if (isSchematic) return &kSchematic;
    if (names.has("Regions")) return &kLitematic;
    if (names.has("size") && (names.has("blocks") || names.has("palette") || names.has("palettes")))
        return &kJavaStructure;
    return names.has("Data") ? &kLevelFile : &kNbtFile;
}

// Bedrock Edition's NBT is little-endian; level.dat has 8 bytes before it, a version and the size of the
// rest.
const FileKind* kindOfBedrockNbt(std::string_view bytes) {
    constexpr std::string_view kUnnamedRoot = "\x0a\0\0"sv;
    if (bytes.starts_with(kUnnamedRoot) && contains(bytes, "structure_world_origin"))
        return &kBedrockStructure;
    const bool isLevel =
        hasAt(bytes, 8, kUnnamedRoot) && littleEndian(bytes, 0) < 256 && littleEndian(bytes, 4) > 0;
    return isLevel ? &kBedrockLevel : nullptr;
}

// Version 1.1.0.0, then whether colors are BGRA, z is mirrored, the data are compressed and sides are hidden.
bool isQubicle(std::string_view bytes) {
    if (!bytes.starts_with("\x01\x01\0\0"sv) || bytes.size() < 24) return false;
    for (const std::size_t at : {4u, 8u, 12u, 16u})
        if (littleEndian(bytes, at) > 1) return false;
    return true;
}

// The first line that is no comment.
bool isObj(std::string_view bytes) {
    while (bytes.starts_with('#')) {
        const std::size_t end = bytes.find('\n');
        if (end == std::string_view::npos) return false;
        bytes.remove_prefix(std::min(bytes.find_first_not_of("\r\n", end), bytes.size()));
    }
    constexpr std::array<std::string_view, 5> kStarts{"v ", "o ", "g ", "mtllib ", "usemtl "};
    return std::ranges::any_of(kStarts, [&](std::string_view start) { return bytes.starts_with(start); });
}

const FileKind* kindOfText(std::string_view bytes) {
    constexpr std::size_t kTextBytes = 1024;
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return nullptr;
    const std::string_view text = bytes.substr(start);
    const std::string head = lowerCase(text.substr(0, kTextBytes));
    if (head.starts_with("<!doctype html") || head.starts_with("<html")) return &kWebPage;
    if (head.starts_with('{') && contains(head, "\"asset\"")) return &kMesh;
    return isObj(text) ? &kMesh : nullptr;
}

bool isBedrockName(const std::string& lowerCaseName) {
    return lowerCaseName.ends_with(".mcworld") || lowerCaseName.ends_with(".mctemplate");
}

const FileKind* kindOfCompressed(std::string_view bytes) {
    const std::string plain = inflateStart(bytes, 16 * kKindBytes);
    if (const FileKind* nbt = kindOfNbt(plain)) return nbt;
    if (hasAt(plain, 257, "ustar")) return &kTar;
    return plain.starts_with("\x27\x1b\xb7\x88"sv) ? &kClassicLevel : &kGzipFile;
}

// "r.X.Z.mcr": as region files are named since 1.2, with another ending.
bool isBetaRegionName(std::string_view name) {
    return name.ends_with(".mcr") && regionPosOf(std::string(name.substr(0, name.size() - 1)) + "a");
}

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

// Whether an entry of the folder satisfies `test`; looks at the first thousands only.
template <class Test>
bool hasEntry(const fs::path& folder, const Test& test) {
    constexpr int kMaxEntries = 4096;
    std::error_code error;
    int count = 0;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && count < kMaxEntries;
         it.increment(error), ++count)
        if (test(*it)) return true;
    return false;
}

bool hasBetaRegions(const fs::path& folder) {
    return hasEntry(folder, [](const fs::directory_entry& entry) {
        return isBetaRegionName(entry.path().filename().string());
    });
}

// Alpha keeps the chunk x, z as c.X.Z.dat two folders deep: x and z modulo 64, all in base 36.
bool isAlphaWorld(const fs::path& folder) {
    const auto isFolder = [](const fs::directory_entry& entry) {
        std::error_code ignored;
        return entry.path().filename().string().size() <= 2 && entry.is_directory(ignored);
    };
    const auto isChunk = [](const fs::directory_entry& entry) {
        const std::string name = entry.path().filename().string();
        return name.starts_with("c.") && name.ends_with(".dat");
    };
    return hasEntry(folder, [&](const fs::directory_entry& x) {
        return isFolder(x) && hasEntry(x.path(), [&](const fs::directory_entry& z) {
                   return isFolder(z) && hasEntry(z.path(), isChunk);
               });
    });
}

// The first kKindBytes of a regular file.
std::optional<std::string> startOf(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::string bytes(kKindBytes, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (file.bad() || (file.fail() && !file.eof())) return std::nullopt;
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

const FileKind* kindOfPath(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return kindOfFolder(path);
    const auto start = startOf(path);
    return start ? kindOfFile(path.filename().string(), *start) : nullptr;
}

}  // namespace

const FileKind* kindOfFile(std::string_view fileName, std::string_view firstBytes) {
    const std::string_view bytes = firstBytes.substr(0, kKindBytes);
    if (bytes.empty()) return &kEmptyFile;
    for (const Magic& magic : kMagics)
        if (hasAt(bytes, magic.at, magic.bytes)) return magic.kind;
    if (bytes.starts_with("PK\x03\x04"sv) || bytes.starts_with("PK\x05\x06"sv)) {
        const bool isBedrock = isBedrockName(lowerCase(fileName)) || contains(bytes, "db/CURRENT") ||
                               contains(bytes, "db/MANIFEST-");
        return isBedrock ? &kBedrockArchive : &kZip;
    }
    if (bytes.starts_with("\x1f\x8b"sv)) return kindOfCompressed(bytes);
    if (const FileKind* bedrock = kindOfBedrockNbt(bytes)) return bedrock;
    if (const FileKind* nbt = kindOfNbt(bytes)) return nbt;
    if (isQubicle(bytes)) return &kQubicle;
    if (const FileKind* text = kindOfText(bytes)) return text;
    if (regionPosOf(fileName)) return &kJavaRegion;
    return isBetaRegionName(fileName) ? &kBetaRegion : nullptr;
}

const FileKind* kindOfFolder(const fs::path& folder) {
    const bool isLevelDb =
        isThere(folder / "CURRENT") && hasEntry(folder, [](const fs::directory_entry& entry) {
            return entry.path().filename().string().starts_with("MANIFEST-");
        });
    if (isLevelDb || isThere(folder / "db" / "CURRENT")) return &kBedrockWorld;
    if (isThere(folder / "world.mt")) return &kLuantiWorld;
    const auto isRegion = [](const fs::directory_entry& entry) {
        return regionPosOf(entry.path().filename().string()).has_value();
    };
    if (isThere(folder / "dimensions" / "minecraft") || hasEntry(folder / "region", isRegion) ||
        hasEntry(folder, isRegion))
        return &kJavaWorld;
    if (hasBetaRegions(folder / "region") || hasBetaRegions(folder)) return &kBetaWorld;
    if (isAlphaWorld(folder)) return &kAlphaWorld;
    return isThere(folder / "level.dat") ? &kJavaWorld : nullptr;
}

base::Error explained(const fs::path& source, std::string_view format, base::Error error) {
    const FileKind* found = kindOfPath(source);
    if (!found || found->format == format) return error;
    if (!found->format.empty())
        return {base::ErrorCode::BadInput, fmt::format("{}: this is {}: use `terrane import {}`",
                                                       source.string(), found->name, found->format)};
    return {base::ErrorCode::Unsupported, fmt::format("{}: this is {}, which cannot be imported: {}",
                                                      source.string(), found->name, found->advice)};
}

}  // namespace terrane::formats
