// What a mistake on the command line is called: one line, which the parser would word for programmers.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace terrane::app {

// "unknown command rendr; did you mean render?"; nothing where the word is a command.
std::optional<std::string> unknownCommand(const CLI::App& app, std::string_view word);

// Arguments that the parser could not use come first, all of them: they may be why another one is missing.
std::string describe(const CLI::App& app, const CLI::ParseError& error);

}  // namespace terrane::app
