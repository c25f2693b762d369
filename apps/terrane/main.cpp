// terrane: reads the command line, runs one command, reports. Exit codes: 0 done, 1 a save is damaged
// (check) or a measurement failed (bench), 2 bad input or a missing means.
#include <execinfo.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/former_names.h"
#include "apps/terrane/options.h"
#include "terrane/base/exception_text.h"
#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace {

constexpr int kBadInput = 2;

// The parser words some mistakes for programmers.
std::string describe(const CLI::ParseError& error) {
    const std::string text = error.what();
    if (error.get_name() != "ArgumentMismatch") return text;
    const std::string option = text.substr(0, text.find(':'));
    return option + (text.ends_with("missing") ? ": its value is missing" : ": given more than once");
}

// One line, where the parser would print its help as well.
int reportBadArguments(const CLI::ParseError& error) {
    terrane::base::logError("{} (see terrane --help)", describe(error));
    return kBadInput;
}

// What is thrown, as by a system without memory or threads left, is reported like any other failure.
terrane::base::Result<void> run(const terrane::app::CommandEntry& command) {
    try {
        return command.run();
    } catch (const std::exception& error) {
        return terrane::base::fail("{}: {}", command.parser->get_name(), terrane::base::textOf(error));
    }
}

terrane::base::Result<void> runTraced(const terrane::app::CommandEntry& command, const std::string& trace) {
    if (trace.empty()) return run(command);
    terrane::base::startTrace();
    const terrane::base::Result<void> result = run(command);
    terrane::base::stopTrace();
    const terrane::base::Result<void> written = terrane::base::writeTrace(trace);
    return result ? written : result;
}

// What the program ends with: results that could not be written are none.
int withOutputWritten(int exitCode) {
    std::cout.flush();
    if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    terrane::base::logError("standard output cannot be written");
    return kBadInput;
}

// glibc loads the unwinder of threads when it needs it first, and ends the process where there is no memory
// for that any more.
void loadUnwinder() {
    void* frame = nullptr;
    backtrace(&frame, 1);
}

}  // namespace

int main(int argc, char** argv) try {
    loadUnwinder();
    using namespace terrane;
    base::setThreadName("main");
    const bool plays = app::defaultCommand() != nullptr;
    CLI::App app(plays ? "Terrane: large voxel worlds. Without a command it plays."
                       : "Terrane: large voxel worlds. This build has no graphics.",
                 "terrane");
    app.set_version_flag("--version", TERRANE_VERSION);
    app.require_subcommand(plays ? 0 : 1, 1);
    const std::vector<app::CommandEntry> commands = app::addCommands(app);
    std::string trace;
    for (const app::CommandEntry& command : commands) app::addTraceOption(*command.parser, trace);
    const std::vector<std::string> named = app::withCurrentNames({argv, static_cast<std::size_t>(argc)});
    std::vector<const char*> arguments;
    for (const std::string& argument : named) arguments.push_back(argument.c_str());
    const std::string_view first = argc > 1 ? argv[1] : "";
    const bool asksForHelp = first == "--help" || first == "-h" || first == "--version";
    if ((argc < 2 || first.starts_with('-')) && !asksForHelp && app::defaultCommand())
        arguments.insert(arguments.begin() + 1, app::defaultCommand());
    try {
        app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::Success& help) {
        return withOutputWritten(app.exit(help));
    } catch (const CLI::ParseError& error) {
        return reportBadArguments(error);
    }
    for (const app::CommandEntry& command : commands) {
        if (!command.parser->parsed()) continue;
        const base::Result<void> result = runTraced(command, trace);
        if (result) return withOutputWritten(command.exitCode());
        base::logError("{}", result.error().message);
        return kBadInput;
    }
    return kBadInput;
} catch (const std::exception& error) {  // memory is too short even for a message
    std::fprintf(stderr, "terrane: error: %s\n", terrane::base::textOf(error));
    return kBadInput;
}
