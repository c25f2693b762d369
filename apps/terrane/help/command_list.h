// The commands and flags of the command line as plain values, read from the parser itself: completions and
// the manual page are made from these.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace terrane::app {

struct FlagEntry {
    std::vector<std::string> names;       // with dashes, "--output", "-o"; none: a plain argument
    std::string value;                    // what it takes, "FILE"; empty: nothing
    std::vector<std::string> valueNames;  // what the value can be; empty: anything
    std::string description, defaultText;
    bool isRequired = false;
    bool takesMany = false;
    bool takesFile() const { return value == "FILE" || value == "PATH"; }
    // "NAME|FILE", "NAME|FILE|URL": a file, too.
    bool takesWorld() const { return value.starts_with("NAME|FILE"); }
    bool takesFolder() const { return value == "DIR"; }
};

struct CommandListEntry {
    std::string name, description;
    std::vector<FlagEntry> flags;
};

struct CommandList {
    std::vector<CommandListEntry> commands;  // in the order of --help
    std::string defaultCommand;              // runs where none is named; empty: none
};

// `defaultCommand` may be null.
CommandList commandList(const CLI::App& app, const char* defaultCommand);

}  // namespace terrane::app
