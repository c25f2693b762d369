// Commands and flags as plain values, read from the parser; completions and the manual page are made from
// them.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace terrane::app {

struct FlagEntry {
    std::vector<std::string> names;       // with dashes, "--output", "-o"; none: a positional argument
    std::string value;                    // kind of value, "FILE"; empty: takes none
    std::vector<std::string> valueNames;  // possible values; empty: any
    std::string description, defaultText;
    bool isRequired = false;
    bool takesMany = false;
    bool takesFile() const { return value == "FILE" || value == "PATH"; }
    // "NAME|FILE" or "NAME|FILE|URL"; files are completed too.
    bool takesWorld() const { return value.starts_with("NAME|FILE"); }
    bool takesFolder() const { return value == "DIR"; }
};

struct CommandListEntry {
    std::string name, description;
    std::vector<FlagEntry> flags;
};

struct CommandList {
    std::vector<CommandListEntry> commands;  // in the order of --help
    std::string defaultCommand;              // runs if none is named; empty: none
};

// `defaultCommand` may be null.
CommandList commandList(const CLI::App& app, const char* defaultCommand);

// Makes completion scripts for shells from the list of commands.
std::string bashCompletion(const CommandList& list);
std::string zshCompletion(const CommandList& list);
std::string fishCompletion(const CommandList& list);

// Makes the manual page terrane(1) from the list of commands.
std::string manPage(const CommandList& list, const std::string& version);

}  // namespace terrane::app
