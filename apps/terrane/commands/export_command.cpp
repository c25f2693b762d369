// terrane export: writes blocks, surfaces and meshes of an area in formats of other programs.
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/commands/progress.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/io/export_formats.h"

namespace terrane::app {
namespace {

struct ExportCommand {
    io::ExportOptions source;
    std::string output;
    std::optional<world::ChunkArea> area;  // all heights; or `box`
    std::string box;                       // "X0,Y0,Z0,X1,Y1,Z1" in blocks, the end excluded
    std::string mapping;                   // for a schematic
    int bits = 8;                          // per pixel of a height map
};

base::Result<world::BlockBox> parseBox(const std::string& text) {
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;  // of the world, excluded
    const auto n =
        TERRANE_TRY(parseWholeNumbers(text, 6, "--box: expected X0,Y0,Z0,X1,Y1,Z1 in blocks", -kEnd, kEnd));
    if (n[0] >= n[3] || n[1] >= n[4] || n[2] >= n[5])
        return base::fail(base::ErrorCode::BadInput, "--box: \"{}\" is empty: the end X1,Y1,Z1 is excluded",
                          text);
    const auto pos = [&](std::size_t first, int less) {
        const auto at = [&](std::size_t axis) { return static_cast<std::int32_t>(n[first + axis] - less); };
        return world::BlockPos{at(0), at(1), at(2)};
    };
    return world::BlockBox{pos(0, 0), pos(3, 1)};
}

base::Result<std::variant<world::ChunkArea, world::BlockBox>> blocksOf(const ExportCommand& options) {
    if (options.area.has_value() == !options.box.empty())
        return base::fail(base::ErrorCode::BadInput, "export needs one of --area and --box");
    if (options.area) return *options.area;
    return TERRANE_TRY(parseBox(options.box));
}

using Exported = base::Result<io::ExportedFile>;

struct ExportFormat {
    std::string_view name, ending;
    Exported (*run)(const io::ExportSource& source, const ExportCommand& command,
                    const io::Progress& progress);
    std::vector<std::string_view> options;  // that not all formats have
};

// For formats without options.
template <Exported (*write)(const io::ExportSource&, const std::filesystem::path&, const io::Progress&)>
Exported exportPlain(const io::ExportSource& source, const ExportCommand& command,
                     const io::Progress& progress) {
    return write(source, command.output, progress);
}

Exported exportSchematic(const io::ExportSource& source, const ExportCommand& command,
                         const io::Progress& progress) {
    return io::exportSchematic(source, command.output, command.mapping, progress);
}

Exported exportPngHeights(const io::ExportSource& source, const ExportCommand& command,
                          const io::Progress& progress) {
    return io::exportPngHeights(source, command.output, command.bits, progress);
}

const std::vector<ExportFormat>& exportFormats() {
    static const std::vector<ExportFormat> formats = {
        {"glb", ".glb", exportPlain<io::exportGlb>, {"--resource-pack"}},
        {"schem", ".schem", exportSchematic, {"--mapping"}},
        {"vox", ".vox", exportPlain<io::exportVox>, {"--resource-pack"}},
        {"png-heights", ".png", exportPngHeights, {"--bits"}},
        {"npy", ".npy", exportPlain<io::exportNpy>, {}},
        {"npy-heights", ".npy", exportPlain<io::exportNpyHeights>, {}},
    };
    return formats;
}

std::vector<std::string> exportNames() {
    std::vector<std::string> names;
    for (const ExportFormat& format : exportFormats()) names.emplace_back(format.name);
    return names;
}

base::Result<void> runExport(const std::string& name, ExportCommand& options, const CLI::App& command) {
    const auto& formats = exportFormats();
    const auto format = std::ranges::find(formats, name, &ExportFormat::name);
    if (format == formats.end())
        return base::fail(base::ErrorCode::BadInput, "export: {}", base::expectedOneOf(exportNames(), name));
    TERRANE_TRY(checkFormatOptions(command, formats, *format));
    if (!CLI::detail::to_lower(options.output).ends_with(format->ending))
        return base::fail(base::ErrorCode::BadInput, "-o: \"{}\" does not end in {}", options.output,
                          format->ending);
    options.source.blocks = TERRANE_TRY(blocksOf(options));
    const auto source = TERRANE_TRY(io::openExport(options.source));
    const auto file = TERRANE_TRY(format->run(source, options, progressBar("exporting")));
    base::logInfo("{}: {}, {} bytes", options.output, file.content, file.bytes);
    return {};
}

}  // namespace

CommandEntry addExport(CLI::App& app) {
    auto options = std::make_shared<ExportCommand>();
    auto format = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("export", "Write an area as a file of another program");
    command->add_option("format", *format, fmt::format("What to write: {}", fmt::join(exportNames(), ", ")))
        ->type_name("CHOICE")
        ->required();
    addOutputOption(*command, options->output, {".glb", ".schem", ".vox", ".png", ".npy"}, "The file");
    addAreaOption(*command, options->area);
    command->add_option("--box", options->box, "Blocks, the end excluded")->type_name("X0,Y0,Z0,X1,Y1,Z1");
    command
        ->add_option("--mapping", options->mapping,
                     "Table of block names for schem, in addition to the built-in one (TOML)")
        ->check(existingFile())
        ->type_name("FILE");
    addChoice<int>(*command, "--bits", options->bits, {{"8", 8}, {"16", 16}},
                   "Bits per pixel of png-heights");
    addResourcePackOption(*command, options->source.resourcePack);
    addWorldOptions(*command, options->source.world);
    addWorldOption(*command, options->source.save, "World to read; missing chunks are generated");
    return {command, [options, format, command] { return runExport(*format, *options, *command); }};
}

}  // namespace terrane::app
