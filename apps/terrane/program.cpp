#include "apps/terrane/program.h"

#include <execinfo.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
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
#include "terrane/base/profile.h"
#include "terrane/base/result.h"

namespace terrane::app {
namespace {

constexpr int kBadInput = 2;

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

// A reader that ends or a limit of file sizes makes a write fail; by default it would end the program, even a
// server with players.
void ignoreFailedWrites() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

// Whether standard output is a pipe whose reader has ended, as in `terrane blocks | head -1`.
bool isReaderGone() {
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

// The exit code of the program: a run whose results could not be written has failed. If the reader of a pipe
// has ended, it is the code that shells show for SIGPIPE, without a message, as of other programs.
int withOutputWritten(int exitCode) {
    std::cout.flush();
    if (std::cout && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exitCode;
    if (isReaderGone()) return 128 + SIGPIPE;
    base::logError("standard output cannot be written");
    return kBadInput;
}

// glibc loads the library that unwinds threads at its first use, and aborts if there is no memory left for
// it.
void loadUnwinder() {
    void* frame = nullptr;
    backtrace(&frame, 1);
}

// Inserts the default command if none is named.
std::vector<std::string> argumentsOf(int argc, char** argv) {
    std::vector<std::string> named = withCurrentNames({argv, static_cast<std::size_t>(argc)});
    const std::string_view first = argc > 1 ? argv[1] : "";
    const bool asksForHelp = first == "--help" || first == "-h" || first == "--version";
    if ((argc < 2 || first.starts_with('-')) && !asksForHelp && defaultCommand())
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
    loadUnwinder();
    ignoreFailedWrites();
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
    if (const auto exitCode = parseArguments(parser, commands, argumentsOf(argc, argv))) return *exitCode;
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
