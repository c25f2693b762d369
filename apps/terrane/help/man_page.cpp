#include "apps/terrane/help/man_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace terrane::app {
namespace {

constexpr const char* kBegin = R"(.SH NAME
terrane \- large voxel worlds to walk, fly and build in
.SH SYNOPSIS
.B terrane
.RI [ COMMAND "] [" OPTION ...]
.SH DESCRIPTION
Makes large worlds of blocks from a number, keeps them in saves, and shows them: in a window, as images, as videos.
)";

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
0
Done.
.TP
1
.B terrane check
found damage,
.B terrane copy
or
.B terrane import
left out what could not be read, or a measurement of
.B terrane bench
failed.
.TP
2
Bad input, or something that is needed is missing; one line on standard error says what.
.SH FILES
.TP
.I ~/.config/terrane/settings.toml
Settings of the window.
.TP
.I ~/.local/share/terrane/NAME.sqlite
Saves.
.TP
.I ~/.local/share/terrane/bookmarks.txt
Bookmarks saved in the window.
.TP
.I ~/.local/share/terrane/screenshots/
Screenshots.
)";

// Escapes the text for roff, so that no character is a request, an escape or a hyphen.
std::string roff(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '\\') {
            escaped += "\\e";
        } else if (letter == '-') {
            escaped += "\\-";
        } else {
            escaped += letter;
        }
    }
    return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string flagHead(const FlagEntry& flag) {
    std::vector<std::string> names;
    for (const std::string& name : flag.names) names.push_back("\\fB" + roff(name) + "\\fR");
    std::string head = fmt::format("{}", fmt::join(names, ", "));
    if (!flag.value.empty()) head += (head.empty() ? "\\fI" : " \\fI") + roff(flag.value) + "\\fR";
    return head;
}

std::string flagText(const FlagEntry& flag) {
    std::string text = flag.description;
    if (flag.isRequired) text += " (required)";
    if (!flag.defaultText.empty()) text += fmt::format(" (default: {})", flag.defaultText);
    return fmt::format(".TP\n{}\n{}\n", flagHead(flag), roff(text));
}

}  // namespace

std::string manPage(const CommandList& list, const std::string& version) {
    std::string page = fmt::format(".TH TERRANE 1 \"\" \"terrane {}\" \"Terrane\"\n{}", version, kBegin);
    if (!list.defaultCommand.empty())
        page += fmt::format("Without a command it does\n.BR {} .\n", roff(list.defaultCommand));
    page += ".SH COMMANDS\n";
    for (const CommandListEntry& command : list.commands) {
        page += fmt::format(".SS terrane {}\n{}\n", roff(command.name), roff(command.description));
        for (const FlagEntry& flag : command.flags) page += flagText(flag);
    }
    return page + kEnd;
}

}  // namespace terrane::app
