// terrane export: writes blocks, surfaces and meshes of an area in formats of other programs.
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/formats/export_formats.h"
#include "apps/terrane/options.h"

namespace terrane::app {
namespace {

struct ExportFormat {
    std::string_view name, ending;
    base::Result<void> (*run)(ExportOptions& options);
    std::vector<std::string_view> options;  // that not all formats have
};

const std::vector<ExportFormat>& exportFormats() {
    static const std::vector<ExportFormat> formats = {
        {"glb", ".glb", exportGlb, {"--resource-pack"}},
        {"schem", ".schem", exportSchematic, {"--mapping"}},
        {"vox", ".vox", exportVox, {"--resource-pack"}},
        {"png-heights", ".png", exportPngHeights, {"--bits"}},
        {"npy", ".npy", exportNpy, {}},
        {"npy-heights", ".npy", exportNpyHeights, {}},
    };
    return formats;
}

std::vector<std::string> exportNames() {
    std::vector<std::string> names;
    for (const ExportFormat& format : exportFormats()) names.emplace_back(format.name);
    return names;
}

base::Result<void> runExport(const std::string& name, ExportOptions& options, const CLI::App& command) {
    const auto& formats = exportFormats();
    const auto format = std::ranges::find(formats, name, &ExportFormat::name);
    if (format == formats.end())
        return base::fail(base::ErrorCode::BadInput, "export: {}", base::expectedOneOf(exportNames(), name));
    TERRANE_TRY(checkFormatOptions(command, formats, *format));
    if (!CLI::detail::to_lower(options.output).ends_with(format->ending))
        return base::fail(base::ErrorCode::BadInput, "-o: \"{}\" does not end in {}", options.output,
                          format->ending);
    return format->run(options);
}

}  // namespace

CommandEntry addExport(CLI::App& app) {
    auto options = std::make_shared<ExportOptions>();
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
    addResourcePackOption(*command, options->resourcePack);
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save, "World to read; missing chunks are generated");
    return {command, [options, format, command] { return runExport(*format, *options, *command); }};
}

}  // namespace terrane::app
