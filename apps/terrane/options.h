// Options that several commands share, as the command line has them.
#pragma once

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/terrane/former_names.h"
#include "apps/terrane/option_values.h"
#include "terrane/base/nearest_name.h"

namespace terrane::app {

void addWorldOptions(CLI::App& command, WorldOptions& options);
// --content, which addWorldOptions() adds, too.
void addContentOption(CLI::App& command, WorldOptions& options);
// "X0,Y0,X1,Y1", the end excluded; not empty and inside the world.
void addAreaOption(CLI::App& command, std::optional<world::ChunkArea>& area);

// --world: NAME, FILE or URL. The folder of a file must be there.
void addWorldOption(CLI::App& command, SaveOptions& save, const std::string& description);
// --world, --recreate and what else says how a world is saved, of commands that make one where none is there.
void addSaveGameOptions(CLI::App& command, SaveOptions& save);
// A world as an argument: NAME, FILE or URL.
void addWorldArgument(CLI::App& command, const std::string& name, std::string& world,
                      const std::string& description);
void addRecreateOption(CLI::App& command, SaveOptions& save);

// -o: the file to write. Refused before the work starts where it cannot be written later, or where its name
// has none of these endings, whatever the case; no endings: any name.
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
        throw CLI::ValidationError(name, base::notOneOf(valueNames, text));
    };
    command
        .add_option_function<std::string>(name, take,
                                          fmt::format("{}: {}", description, fmt::join(valueNames, ", ")))
        ->type_name("CHOICE")
        ->default_str(defaultValue);
}

// "1,2.5,-3": exactly `count` numbers. Throws CLI::ValidationError.
std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& form);

}  // namespace terrane::app
