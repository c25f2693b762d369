// terrane import: imports worlds, schematics and models of other programs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/commands/progress.h"
#include "apps/terrane/options.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/io/minecraft_import.h"
#include "terrane/io/volume_import.h"

namespace terrane::app {
namespace {

struct ImportCommand {
    io::ImportOptions source;
    io::MinecraftOptions minecraft;
    bool skipsAir = false;  // of a volume
    std::string at;         // "X,Y" or "X,Y,Z" in blocks; empty: 0
    std::string output;     // a structure file instead of a world
    std::string report;     // file; empty: none
    int exitCode = 0;       // after the run
};

constexpr std::size_t kLoggedNames = 5;

std::uint64_t sumOf(const std::map<std::string, std::uint64_t>& counts) {
    std::uint64_t sum = 0;
    for (const auto& [name, count] : counts) sum += count;
    return sum;
}

// "minecraft:a (12), minecraft:b (3) and 4 more": the most frequent first.
std::string mostOf(const std::map<std::string, std::uint64_t>& counts) {
    std::vector<std::pair<std::string, std::uint64_t>> sorted(counts.begin(), counts.end());
    std::ranges::stable_sort(sorted, std::ranges::greater(), [](const auto& entry) { return entry.second; });
    std::string text;
    for (std::size_t k = 0; k < std::min(kLoggedNames, sorted.size()); ++k)
        text += fmt::format("{}{} ({})", k > 0 ? ", " : "", sorted[k].first, sorted[k].second);
    if (sorted.size() > kLoggedNames) text += fmt::format(" and {} more", sorted.size() - kLoggedNames);
    return text;
}

// `moving` is the option that moves the source up and down.
void logReport(const io::ImportReport& report, std::string_view moving) {
    const formats::ImportCounts& counts = report.counts;
    base::logInfo("{} chunks with {} blocks imported; {} had edits in the world and stay as they are",
                  report.chunks, sumOf(counts.blocks), report.skipped);
    if (report.unfinished > 0)
        base::logInfo("{} of the chunks are not completely generated in the source", report.unfinished);
    if (report.damageCount > 0) base::logWarning("{} chunks or files could not be read", report.damageCount);
    if (!counts.unknown.empty())
        base::logWarning("{} blocks are unknown and became \"missing\": {}", sumOf(counts.unknown),
                         mostOf(counts.unknown));
    if (counts.below + counts.above > 0)
        base::logWarning("{} blocks below and {} above the world's heights are left out (see {})",
                         counts.below, counts.above, moving);
    if (!counts.blockEntities.empty())
        base::logInfo("contents of {} blocks are left out: {}", sumOf(counts.blockEntities),
                      mostOf(counts.blockEntities));
}

// Names come from the file and may be invalid UTF-8.
std::string jsonOf(const io::ImportReport& report) {
    const formats::ImportCounts& counts = report.counts;
    const nlohmann::json root = {{"chunks", report.chunks},         {"skipped", report.skipped},
                                 {"unfinished", report.unfinished}, {"damage_count", report.damageCount},
                                 {"damaged", report.damaged},       {"blocks", counts.blocks},
                                 {"unknown", counts.unknown},       {"block_entities", counts.blockEntities},
                                 {"below", counts.below},           {"above", counts.above}};
    return root.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

base::Result<void> finish(const ImportCommand& command, const io::ImportReport& report,
                          std::string_view moving) {
    logReport(report, moving);
    return command.report.empty() ? base::Result<void>() : base::writeFile(command.report, jsonOf(report));
}

base::Result<void> checkTarget(const ImportCommand& command) {
    if (!command.source.save.world.empty()) return {};
    return base::fail(base::ErrorCode::BadInput, "import needs --world NAME|FILE|URL");
}

// "X,Y" in blocks: the offset of Minecraft's origin, returned in chunks.
base::Result<world::ChunkPos> movedBy(const std::string& at) {
    if (at.empty()) return world::ChunkPos{};
    const auto numbers = parseNumbers(at, 2, "--at: expected X,Y in blocks");
    for (const double number : numbers) {
        const double chunks = number / world::kChunkSize;
        // The end itself too: Minecraft's first chunk is the one before it.
        if (chunks != std::floor(chunks) || chunks < world::kMinChunk || chunks > world::kMaxChunk + 1.0)
            return base::fail(base::ErrorCode::BadInput,
                              "--at: expected multiples of {} within the world, got \"{}\"",
                              world::kChunkSize, at);
    }
    return world::ChunkPos{static_cast<std::int32_t>(numbers[0] / world::kChunkSize),
                           static_cast<std::int32_t>(numbers[1] / world::kChunkSize)};
}

base::Result<void> importMinecraft(ImportCommand& command) {
    const auto at = TERRANE_TRY(movedBy(command.at));
    TERRANE_TRY(checkTarget(command));
    command.minecraft.at = at;
    const auto report =
        TERRANE_TRY(io::importMinecraft(command.source, command.minecraft, progressBar("importing")));
    command.exitCode = report.damageCount > 0 ? 1 : 0;
    TERRANE_TRY(finish(command, report, "--shift"));
    if (report.chunks > 0 || report.skipped > 0) return {};
    return base::fail(base::ErrorCode::Damaged,
                      "{}: nothing is imported: {} chunks or files cannot be read, {} chunks have no blocks",
                      command.source.source.string(), report.damageCount, report.empty);
}

base::Result<world::BlockPos> cornerOf(const std::string& at) {
    if (at.empty()) return base::fail(base::ErrorCode::BadInput, "import needs --at X,Y,Z, or -o FILE");
    const auto numbers =
        TERRANE_TRY(parseWholeNumbers(at, 3, "--at: expected X,Y,Z in blocks", INT32_MIN, INT32_MAX));
    const auto number = [&](std::size_t axis) { return static_cast<std::int32_t>(numbers[axis]); };
    return world::BlockPos{number(0), number(1), number(2)};
}

// Writes the structure and the report, or neither.
base::Result<void> writeStructure(const ImportCommand& command, const io::ImportedStructure& imported) {
    const std::string report = jsonOf(imported.report);
    std::vector<base::FileToWrite> files{
        {command.output, {reinterpret_cast<const char*>(imported.bytes.data()), imported.bytes.size()}}};
    if (!command.report.empty()) files.push_back({command.report, report});
    std::error_code ignored;  // writeFiles() reports the error
    std::filesystem::create_directories(std::filesystem::path(command.output).parent_path(), ignored);
    TERRANE_TRY(base::writeFiles(files));
    logReport(imported.report, "--at");
    return {};
}

base::Result<void> importVolume(ImportCommand& command, io::VolumeFormat format) {
    if (!command.output.empty()) {
        if (!command.source.save.world.empty() || !command.at.empty())
            return base::fail(base::ErrorCode::BadInput, "-o cannot be used with --world and --at");
        const auto imported = TERRANE_TRY(io::importStructure(command.source, format));
        return writeStructure(command, imported);
    }
    const auto corner = TERRANE_TRY(cornerOf(command.at));
    TERRANE_TRY(checkTarget(command));
    const auto report = TERRANE_TRY(
        io::importVolume(command.source, {format, corner, command.skipsAir}, progressBar("importing")));
    return finish(command, report, "--at");
}

base::Result<void> importSchematic(ImportCommand& command) {
    return importVolume(command, io::VolumeFormat::Schematic);
}

base::Result<void> importVox(ImportCommand& command) {
    return importVolume(command, io::VolumeFormat::Vox);
}

struct ImportFormat {
    std::string_view name;
    base::Result<void> (*run)(ImportCommand& command);
    std::vector<std::string_view> options;  // that not all formats have
};

const std::vector<ImportFormat>& importFormats() {
    static const std::vector<ImportFormat> formats = {
        {"minecraft", importMinecraft, {"--dimension", "--area", "--shift"}},
        {"schem", importSchematic, {"--output", "--skip-air"}},
        {"vox", importVox, {"--output", "--skip-air"}},
    };
    return formats;
}

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const ImportFormat& format : importFormats()) names.emplace_back(format.name);
    return names;
}

base::Result<void> runImport(const std::string& name, ImportCommand& options, const CLI::App& command) {
    const auto& formats = importFormats();
    const auto format = std::ranges::find(formats, name, &ImportFormat::name);
    if (format == formats.end())
        return base::fail(base::ErrorCode::BadInput, "import: {}", base::expectedOneOf(formatNames(), name));
    TERRANE_TRY(checkFormatOptions(command, formats, *format));
    return format->run(options);
}

}  // namespace

CommandEntry addImport(CLI::App& app) {
    auto options = std::make_shared<ImportCommand>();
    auto format = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "import", "Import worlds and models of other programs; exit code 1 if something could not be read");
    command
        ->add_option("format", *format, fmt::format("What the source is: {}", fmt::join(formatNames(), ", ")))
        ->type_name("CHOICE")
        ->required();
    command->add_option("source", options->source.source, "The file, or the folder of a world")
        ->type_name("PATH")
        ->required();
    addWorldOption(*command, options->source.save, "World to write into; created if needed");
    command
        ->add_option("--mapping", options->source.mapping,
                     "Table from names to blocks, in addition to the built-in one (TOML)")
        ->check(existingFile())
        ->type_name("FILE");
    command->add_option("--at", options->at, "Position of the source's 0,0 in blocks")->type_name("X,Y[,Z]");
    addChoice<std::string>(*command, "--dimension", options->minecraft.dimension,
                           {{"overworld", "overworld"}, {"nether", "nether"}, {"end", "end"}},
                           "Dimension of a world of Minecraft");
    addAreaOption(*command, options->minecraft.area);
    command
        ->add_option("--shift", options->minecraft.shift,
                     "Blocks added to the heights of a world of Minecraft")
        ->check(numberFrom(-4096, 4096))
        ->type_name("BLOCKS");
    command->add_flag("--skip-air", options->skipsAir, "Do not import air");
    addOutputOption(*command, options->output, {".structure"}, "Write a structure file instead of a world");
    command->get_option("--output")->required(false);
    addReportOption(*command, options->report);
    addWorldOptions(*command, options->source.world);
    return {command, [options, format, command] { return runImport(*format, *options, *command); },
            [options] { return options->exitCode; }};
}

}  // namespace terrane::app
