// terrane import: imports worlds, schematics and models of other programs.
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/formats/import_world.h"
#include "apps/terrane/formats/minecraft_import.h"
#include "apps/terrane/formats/volume_import.h"
#include "apps/terrane/options.h"

namespace terrane::app {
namespace {

struct ImportFormat {
    std::string_view name;
    base::Result<void> (*run)(ImportOptions& options);
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

base::Result<void> runImport(const std::string& name, ImportOptions& options, const CLI::App& command) {
    const auto& formats = importFormats();
    const auto format = std::ranges::find(formats, name, &ImportFormat::name);
    if (format == formats.end())
        return base::fail(base::ErrorCode::BadInput, "import: {}", base::expectedOneOf(formatNames(), name));
    TERRANE_TRY(checkFormatOptions(command, formats, *format));
    return format->run(options);
}

}  // namespace

CommandEntry addImport(CLI::App& app) {
    auto options = std::make_shared<ImportOptions>();
    auto format = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "import", "Import worlds and models of other programs; exit code 1 if something could not be read");
    command
        ->add_option("format", *format, fmt::format("What the source is: {}", fmt::join(formatNames(), ", ")))
        ->type_name("CHOICE")
        ->required();
    command->add_option("source", options->source, "The file, or the folder of a world")
        ->type_name("PATH")
        ->required();
    addWorldOption(*command, options->save, "World to write into; created if needed");
    command
        ->add_option("--mapping", options->mapping,
                     "Table from names to blocks, in addition to the built-in one (TOML)")
        ->check(existingFile())
        ->type_name("FILE");
    command->add_option("--at", options->at, "Position of the source's 0,0 in blocks")->type_name("X,Y[,Z]");
    addChoice<std::string>(*command, "--dimension", options->dimension,
                           {{"overworld", "overworld"}, {"nether", "nether"}, {"end", "end"}},
                           "Dimension of a world of Minecraft");
    addAreaOption(*command, options->area);
    command->add_option("--shift", options->shift, "Blocks added to the heights of a world of Minecraft")
        ->check(numberFrom(-4096, 4096))
        ->type_name("BLOCKS");
    command->add_flag("--skip-air", options->skipsAir, "Do not import air");
    addOutputOption(*command, options->output, {".structure"}, "Write a structure file instead of a world");
    command->get_option("--output")->required(false);
    addReportOption(*command, options->report);
    addWorldOptions(*command, options->world);
    return {command, [options, format, command] { return runImport(*format, *options, *command); },
            [options] { return options->exitCode; }};
}

}  // namespace terrane::app
