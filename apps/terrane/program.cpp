#include "apps/terrane/program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/help/argument_errors.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/log.h"
#include "terrane/base/platform.h"
#include "terrane/base/profile.h"
#include "terrane/base/result.h"

namespace terrane::app {
namespace {

constexpr int kBadInput = 2;
constexpr int kBrokenPipe = 128 + 13;  // SIGPIPE

// Exceptions, such as those of a system without memory or threads left, are reported like other failures.
base::Result<void> run(const CommandEntry& command) {
    try {
        return command.run();
    } catch (const std::exception& error) {
        // A text longer than the buffer already fails while it is printed: withOutputWritten() reports it.
        if (std::ferror(stdout) != 0) return {};
        return base::fail("{}: {}", command.parser->get_name(), base::textOf(error));
    }
}

base::Result<void> runTraced(const CommandEntry& command, const std::string& trace) {
    if (trace.empty()) return run(command);
    base::startTrace();
    const base::Result<void> result = run(command);
    base::stopTrace();
    const base::Result<void> written = base::writeTrace(trace);
    return result ? written : result;
}

// The exit code of the program: a run whose results could not be written has failed. If the reader of a pipe
// has ended, it is the code that shells show for SIGPIPE, without a message, as of other programs.
int withOutputWritten(int exitCode) {
    std::cout.flush();
    if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    if (base::platform::isOutputReaderGone()) return kBrokenPipe;
    base::logError("standard output cannot be written");
    return kBadInput;
}

// Inserts the default command if none is named.
std::vector<std::string> withCommand(const std::vector<std::string>& given) {
    std::vector<const char*> texts;
    for (const std::string& text : given) texts.push_back(text.c_str());
    std::vector<std::string> named = withCurrentNames(texts);
    const std::string_view first = given.size() > 1 ? std::string_view(given[1]) : "";
    const bool asksForHelp = first == "--help" || first == "-h" || first == "--version";
    if ((given.size() < 2 || first.starts_with('-')) && !asksForHelp && defaultCommand())
        named.insert(named.begin() + 1, defaultCommand());
    return named;
}

const CommandEntry* commandNamed(std::span<const CommandEntry> commands,
                                 const std::vector<std::string>& named) {
    if (named.size() < 2) return nullptr;
    const auto found = std::ranges::find_if(
        commands, [&](const CommandEntry& command) { return command.parser->get_name() == named[1]; });
    return found == commands.end() ? nullptr : &*found;
}

// The error that ends the program. `command`: may be null.
void report(const CommandEntry* command, const std::string& error) {
    base::logError("{}", error);
    if (command && command->showError) command->showError(error);
}

// Returns an exit code if parsing ends the program: after help or an error.
std::optional<int> parseArguments(CLI::App& parser, std::span<const CommandEntry> commands,
                                  const std::vector<std::string>& named) {
    if (named.size() > 1 && !named[1].starts_with('-')) {
        if (const auto unknown = unknownCommand(parser, named[1])) {
            base::logError("{}", *unknown);
            return kBadInput;
        }
    }
    std::vector<const char*> arguments;
    for (const std::string& argument : named) arguments.push_back(argument.c_str());
    try {
        parser.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::Success& help) {
        return withOutputWritten(parser.exit(help));
    } catch (const CLI::ParseError& error) {
        report(commandNamed(commands, named), app::describe(parser, error));
        return kBadInput;
    }
    return std::nullopt;
}

}  // namespace

int runProgram(int argc, char** argv) try {
    const std::vector<std::string> given = base::platform::prepareProgram(argc, argv);
    base::setThreadName("main");
    const bool plays = defaultCommand() != nullptr;
    CLI::App parser(plays ? "Terrane: large voxel worlds. Without a command it plays."
                          : "Terrane: large voxel worlds. This build has no graphics.",
                    "terrane");
    parser.set_version_flag("--version", TERRANE_VERSION);
    parser.require_subcommand(plays ? 0 : 1, 1);
    const std::vector<CommandEntry> commands = addCommands(parser);
    std::string trace;
    for (const CommandEntry& command : commands) addTraceOption(*command.parser, trace);
    if (const auto exitCode = parseArguments(parser, commands, withCommand(given))) return *exitCode;
    for (const CommandEntry& command : commands) {
        if (!command.parser->parsed()) continue;
        base::Result<void> result = checkOutputs(*command.parser);
        if (result) result = runTraced(command, trace);
        if (result) return withOutputWritten(command.exitCode());
        report(&command, result.error().message);
        return kBadInput;
    }
    return kBadInput;
} catch (const std::exception& error) {  // there was no memory to format a message
    std::fprintf(stderr, "terrane: error: %s\n", base::textOf(error));
    return kBadInput;
}

}  // namespace terrane::app
