// The subcommands. Each function adds one to the parser and returns how to run it.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::app {

using Command = std::function<base::Result<void>()>;

struct PlayHost;  // window/play_flow.h

struct CommandEntry {
    CLI::App* parser;
    Command run;
    // The exit code after a run without an error.
    std::function<int()> exitCode = [] { return 0; };
    // Shows the error that ends the program to a player who does not see standard error; empty: it is only
    // written there.
    std::function<void(const std::string&)> showError = {};
};

// Adds all commands of this build: all_commands.cpp, or server_commands.cpp in a build without graphics.
std::vector<CommandEntry> addCommands(CLI::App& app);
// The command that runs if none is named; null: one must be named.
const char* defaultCommand();

CommandEntry addPlay(CLI::App& app);
CommandEntry addPlay(CLI::App& app, std::shared_ptr<PlayHost> host);
CommandEntry addRender(CLI::App& app);
CommandEntry addRecord(CLI::App& app);
CommandEntry addFlightBench(CLI::App& app);
CommandEntry addGenerate(CLI::App& app);
CommandEntry addMap(CLI::App& app);
CommandEntry addDump(CLI::App& app);
CommandEntry addCheck(CLI::App& app);
CommandEntry addCopy(CLI::App& app);
CommandEntry addBackup(CLI::App& app);
CommandEntry addImport(CLI::App& app);
CommandEntry addExport(CLI::App& app);
CommandEntry addWork(CLI::App& app);
CommandEntry addBlocks(CLI::App& app);
CommandEntry addPacks(CLI::App& app);
CommandEntry addBench(CLI::App& app);
CommandEntry addServe(CLI::App& app);
CommandEntry addHistory(CLI::App& app);
CommandEntry addBots(CLI::App& app);
CommandEntry addInfo(CLI::App& app);
CommandEntry addCompletion(CLI::App& app);
CommandEntry addMan(CLI::App& app);

}  // namespace terrane::app
