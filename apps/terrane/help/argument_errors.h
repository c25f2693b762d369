// Describes an error on the command line in one line for users; the parser's own texts are for programmers.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace terrane::app {

// "unknown command rendr; did you mean render?"; none if the word is a command.
std::optional<std::string> unknownCommand(const CLI::App& app, std::string_view word);

// Names all unknown arguments first: they may be the reason why a required one is missing.
std::string describe(const CLI::App& app, const CLI::ParseError& error);

}  // namespace terrane::app
