#include "apps/terrane/help/argument_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "terrane/base/text.h"

namespace terrane::app {
namespace {

using base::didYouMean;
using base::nearestName;

// False for a negative number, such as "-5".
bool isOption(std::string_view argument) {
    return argument.starts_with("--") ||
           (argument.size() > 1 && argument[0] == '-' && (argument[1] < '0' || argument[1] > '9'));
}

std::vector<std::string> optionNames(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty())
            names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
    return names;
}

// An unknown option as given, and the nearest known one.
struct UnknownOption {
    std::string given;
    std::string nearest;  // without dashes; empty: none
    bool takesNext = false;
};

UnknownOption unknownOption(const CLI::App& command, const std::string& argument) {
    const std::string given = argument.substr(0, argument.find('='));
    const std::string word = given.substr(std::min(given.find_first_not_of('-'), given.size()));
    UnknownOption unknown{given, nearestName(word, optionNames(command))};
    if (unknown.nearest.empty()) return unknown;
    const bool takesValue = command.get_option("--" + unknown.nearest)->get_items_expected_max() > 0;
    unknown.takesNext = takesValue && given.size() == argument.size();
    return unknown;
}

// All unknown arguments in order. A word after a misspelled option that takes a value is that value.
std::vector<std::string> unknownArguments(const CLI::App& command) {
    std::vector<std::string> told;
    bool isValue = false;
    for (const std::string& argument : command.remaining()) {
        if (argument == "--") continue;
        if (!isOption(argument)) {
            if (!isValue) told.push_back("unknown argument " + argument);
            isValue = false;
            continue;
        }
        const UnknownOption unknown = unknownOption(command, argument);
        isValue = unknown.takesNext;
        const std::string question =
            unknown.nearest.empty() ? "" : "; did you mean --" + unknown.nearest + "?";
        told.push_back("unknown option " + unknown.given + question);
    }
    return told;
}

std::string sentence(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        text += (text.empty() ? "" : text.ends_with('?') ? " " : "; ") + part;
    return text;
}

std::string inOtherWords(const CLI::ParseError& error) {
    const std::string text = error.what();
    if (error.get_name() != "ArgumentMismatch") return text;
    const std::string option = text.substr(0, text.find(':'));
    return option + (text.ends_with("missing") ? ": its value is missing" : ": given more than once");
}

}  // namespace

std::optional<std::string> unknownCommand(const CLI::App& app, std::string_view word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    if (std::ranges::find(names, word) != names.end()) return std::nullopt;
    const std::string named = word.empty() ? "\"\"" : std::string(word);
    return fmt::format("unknown command {}{} (see terrane --help)", named, didYouMean(word, names));
}

std::string describe(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::string unknown = sentence(unknownArguments(command));
    const std::string name = chosen.empty() ? "terrane" : "terrane " + command.get_name();
    return fmt::format("{} (see {} --help)", unknown.empty() ? inOtherWords(error) : unknown, name);
}

}  // namespace terrane::app
