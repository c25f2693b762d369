// Command line options that several commands share.
#pragma once

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/base/text.h"
#include "terrane/io/world_options.h"
#include "terrane/world/coords.h"

namespace terrane::app {

// Commands, flags and values that were renamed in 0.2. The old names are accepted for one version: on the
// command line, in settings.toml and in path files. The help does not list them.
// The current name of a flag without dashes, or of a value of an option. Other names are returned unchanged.
std::string_view currentFlag(std::string_view name);
std::string_view currentValue(std::string_view value);

// The command line with current names: arguments[1] is the command, flags are --name or --name=value.
std::vector<std::string> withCurrentNames(std::span<const char* const> arguments);

// The values of an option by name.
template <class T>
using EnumNames = std::span<const std::pair<std::string, T>>;

void addWorldOptions(CLI::App& command, io::WorldOptions& options);
// Adds --content alone; addWorldOptions() includes it.
void addContentOption(CLI::App& command, io::WorldOptions& options);
// --area "X0,Y0,X1,Y1" in chunks, the end excluded; not empty and inside the world.
void addAreaOption(CLI::App& command, std::optional<world::ChunkArea>& area);

// --radius or --area; at most one may be given.
struct AreaOptions {
    std::optional<int> radius;  // (2R+1)² chunks around 0,0
    std::optional<world::ChunkArea> area;
};
// `description`: of --radius, which is 0 to `maxRadius`.
void addAreaOptions(CLI::App& command, AreaOptions& options, int maxRadius, const std::string& description);
// None if neither option is given.
std::optional<world::ChunkArea> areaOf(const AreaOptions& options);

// --world: NAME, FILE or URL. The folder of a file must exist.
void addWorldOption(CLI::App& command, io::SaveOptions& save, const std::string& description);
// --world, --recreate, --regenerate and --store-generated, for commands that create a missing world.
void addSaveGameOptions(CLI::App& command, io::SaveOptions& save);
// Fails for options that change a world, if none is named.
[[nodiscard]] base::Result<void> checkSaveOptions(const io::SaveOptions& save);
// A required positional argument that names a world: NAME, FILE or URL.
void addWorldArgument(CLI::App& command, const std::string& name, std::string& world,
                      const std::string& description);
void addRecreateOption(CLI::App& command, io::SaveOptions& save);

// --mode: creative or survival; empty: that of the world.
void addModeOption(CLI::App& command, std::string& mode);

// -o: the file to write. Checked before the work starts: its folder must be writable and its name must have
// one of these endings, ignoring case; no endings: any name.
void addOutputOption(CLI::App& command, std::string& output, const std::vector<std::string>& endings,
                     const std::string& description);

// --resource-pack: a folder; empty: none.
void addResourcePackOption(CLI::App& command, std::string& folder);

// --trace: the file to write; empty: none.
void addTraceOption(CLI::App& command, std::string& trace);

// --report: the file to write; empty: none.
void addReportOption(CLI::App& command, std::string& report);

// For CLI::Option::check.
CLI::Validator numberFrom(double low, double high);
CLI::Validator existingFolder();  // empty: none
CLI::Validator existingFile();

// An option that takes one of a few named values.
template <class T>
void addChoice(CLI::App& command, const std::string& name, T& value,
               const std::vector<std::pair<std::string, T>>& choices, const std::string& description) {
    std::vector<std::string> valueNames;
    std::string defaultValue;
    for (const auto& [valueName, choice] : choices) {
        valueNames.push_back(valueName);
        if (choice == value) defaultValue = valueName;
    }
    const auto take = [name, &value, choices, valueNames](const std::string& text) {
        for (const auto& [valueName, choice] : choices) {
            if (valueName != currentValue(text)) continue;
            value = choice;
            return;
        }
        throw CLI::ValidationError(name, base::expectedOneOf(valueNames, text));
    };
    command
        .add_option_function<std::string>(name, take,
                                          fmt::format("{}: {}", description, fmt::join(valueNames, ", ")))
        ->type_name("CHOICE")
        ->default_str(defaultValue);
}

// Fails for a given option that only other formats have. A Format has a `name` and lists its `options`,
// except those that all formats have.
template <class Format>
base::Result<void> checkFormatOptions(const CLI::App& command, const std::vector<Format>& formats,
                                      const Format& chosen) {
    for (const Format& format : formats) {
        for (const std::string_view option : format.options) {
            const bool isKnown = std::ranges::find(chosen.options, option) != chosen.options.end();
            if (!isKnown && !command.get_option(std::string(option))->empty())
                return base::fail(base::ErrorCode::BadInput, "{} cannot be used with {}", option,
                                  chosen.name);
        }
    }
    return {};
}

// "1,2.5,-3": exactly `count` numbers. Throws CLI::ValidationError.
std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& form);

// As parseNumbers(), but fails for numbers that are not integers from `low` to `high`. `form` starts with the
// option and a colon.
[[nodiscard]] base::Result<std::vector<std::int64_t>> parseWholeNumbers(const std::string& text,
                                                                        std::size_t count,
                                                                        const std::string& form,
                                                                        std::int64_t low, std::int64_t high);

}  // namespace terrane::app
