#include "apps/terrane/help/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace terrane::app {

namespace {

// The parser appends the limits of a number to its type: "INT:1 to 64".
std::string valueOf(const CLI::Option& option) {
    if (option.get_items_expected_max() == 0) return {};
    const std::string type = option.get_type_name();
    return type.substr(0, type.find(':'));
}

// The description of an option of type CHOICE ends in ": " and its values.
std::vector<std::string> valueNamesOf(const CLI::Option& option) {
    const std::string& description = option.get_description();
    const std::size_t colon = description.rfind(": ");
    if (valueOf(option) != "CHOICE" || colon == std::string::npos) return {};
    return CLI::detail::split(CLI::detail::find_and_replace(description.substr(colon + 2), ", ", ","), ',');
}

FlagEntry flagOf(const CLI::Option& option) {
    FlagEntry flag;
    for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
    for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
    flag.value = valueOf(option);
    flag.valueNames = valueNamesOf(option);
    flag.description = option.get_description();
    flag.defaultText = option.get_default_str();
    flag.isRequired = option.get_required();
    flag.takesMany = option.get_items_expected_max() > 1;
    return flag;
}

}  // namespace

CommandList commandList(const CLI::App& app, const char* defaultCommand) {
    CommandList list{{}, defaultCommand ? defaultCommand : ""};
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        CommandListEntry entry{command->get_name(), command->get_description(), {}};
        for (const CLI::Option* option : command->get_options())
            if (!option->get_group().empty()) entry.flags.push_back(flagOf(*option));
        list.commands.push_back(std::move(entry));
    }
    return list;
}

namespace {

using Commands = std::vector<CommandListEntry>;

std::string joined(const std::vector<std::string>& valueNames) {
    return fmt::format("{}", fmt::join(valueNames, " "));
}

// Completions after a command: flags, and the values of positional arguments.
std::vector<std::string> namesOf(const CommandListEntry& command) {
    std::vector<std::string> names;
    for (const FlagEntry& flag : command.flags) {
        const std::vector<std::string>& more = flag.names.empty() ? flag.valueNames : flag.names;
        names.insert(names.end(), more.begin(), more.end());
    }
    return names;
}

// The positional argument that is a file or a world.
const FlagEntry* plainArgument(const CommandListEntry& command) {
    for (const FlagEntry& flag : command.flags)
        if (flag.names.empty() && (flag.takesFile() || flag.takesWorld())) return &flag;
    return nullptr;
}

// Quotes the text for all three shells.
std::string inQuotes(std::string text) {
    return "'" + CLI::detail::find_and_replace(std::move(text), "'", "'\\''") + "'";
}

// Bash code that completes the value of a flag.
std::string bashValues(const FlagEntry& flag) {
    if (flag.takesWorld()) return "_terrane_worlds";
    if (flag.takesFile()) return "_terrane_files -f";
    if (flag.takesFolder()) return "_terrane_files -d";
    return flag.valueNames.empty() ? ":"
                                   : fmt::format("_terrane_words {}", inQuotes(joined(flag.valueNames)));
}

std::string zshAction(const FlagEntry& flag) {
    if (flag.takesWorld()) return "_terrane_worlds";
    if (flag.takesFile()) return "_files";
    if (flag.takesFolder()) return "_files -/";
    return flag.valueNames.empty() ? " " : "(" + joined(flag.valueNames) + ")";
}

// An _arguments specification for one name of a flag.
std::string zshFlag(const FlagEntry& flag, const std::string& name) {
    std::string description = flag.description;
    for (const char* special : {"\\", "[", "]", ":"})
        description = CLI::detail::find_and_replace(description, special, std::string("\\") + special);
    const std::string value = flag.value.empty() ? "" : fmt::format(":{}:{}", flag.value, zshAction(flag));
    return inQuotes(fmt::format("{}[{}]{}", name, description, value));
}

std::string fishFlag(const FlagEntry& flag, const std::string& condition) {
    std::string line = fmt::format("complete -c terrane -n {}", inQuotes(condition));
    for (const std::string& name : flag.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (flag.takesWorld()) {
        line += " -r -F -a '(__terrane_worlds)'";
    } else if (flag.takesFile() || flag.takesFolder()) {
        line += " -r -F";
    } else if (!flag.value.empty()) {
        line += " -x";
        if (!flag.valueNames.empty()) line += fmt::format(" -a {}", inQuotes(joined(flag.valueNames)));
    }
    return line + fmt::format(" -d {}\n", inQuotes(flag.description));
}

std::vector<std::string> commandNames(const Commands& commands) {
    std::vector<std::string> names;
    for (const CommandListEntry& command : commands) names.push_back(command.name);
    return names;
}

// The beginnings of the scripts. Worlds are searched in the data folder (store/save_path.h) at completion
// time.
constexpr std::string_view kBashBegin = R"(# bash completion for terrane, made by: terrane completion bash
_terrane_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }
_terrane_files() { compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen "$1" -- "$cur"); }
_terrane_worlds() {
    _terrane_files -f
    local data=${XDG_DATA_HOME-} world
    [[ $data == /* ]] || data=${HOME-}/.local/share
    for world in "$data"/terrane/*.sqlite; do
        world=${world##*/} world=${world%.sqlite}
        if [[ $world != '*' && $world == "$cur"* ]]; then COMPREPLY+=("$world"); fi
    done
}
)";

constexpr std::string_view kZshBegin = R"(#compdef terrane
# zsh completion for terrane, made by: terrane completion zsh
_terrane_worlds() {
    local data=$XDG_DATA_HOME expl
    [[ $data == /* ]] || data=$HOME/.local/share
    local -a worlds=($data/terrane/*.sqlite(N:t:r))
    _wanted worlds expl world compadd -a worlds
    _files
}
)";

constexpr std::string_view kFishBegin = R"(# fish completion for terrane, made by: terrane completion fish
function __terrane_worlds
    set -l data "$XDG_DATA_HOME"
    string match -q '/*' -- $data; or set data "$HOME/.local/share"
    for file in $data/terrane/*.sqlite
        string replace -r '.*/(.*)\.sqlite$' '$1' -- $file
    end
end
)";

}  // namespace

std::string bashCompletion(const CommandList& list) {
    const Commands& commands = list.commands;
    std::string script(kBashBegin);
    script += R"(_terrane() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command=)";
    script += list.defaultCommand;
    script += R"( more=
    COMPREPLY=()
    if ((COMP_CWORD > 1)) && [[ ${COMP_WORDS[1]} != -* ]]; then command=${COMP_WORDS[1]}; fi
)";
    script += fmt::format("    if ((COMP_CWORD == 1)); then more='{} --help --version'; fi\n",
                          joined(commandNames(commands)));
    script += "    case \"$command $prev\" in\n";
    for (const CommandListEntry& command : commands) {
        for (const FlagEntry& flag : command.flags) {
            for (const std::string& name : flag.value.empty() ? std::vector<std::string>() : flag.names)
                script +=
                    fmt::format("        '{} {}') {}; return ;;\n", command.name, name, bashValues(flag));
        }
    }
    script += "    esac\n    case $command in\n";
    for (const CommandListEntry& command : commands) {
        const FlagEntry* plain = plainArgument(command);
        const std::string files =
            plain ? fmt::format("if [[ $cur != -* ]]; then {}; return; fi; ", bashValues(*plain)) : "";
        script += fmt::format("        {}) {}_terrane_words \"$more {}\" ;;\n", command.name, files,
                              joined(namesOf(command)));
    }
    return script + "    esac\n}\ncomplete -F _terrane terrane\n";
}

std::string zshCompletion(const CommandList& list) {
    const Commands& commands = list.commands;
    std::string script(kZshBegin);
    script += R"(_terrane() {
    local command=)";
    script += list.defaultCommand;
    script += "\n    local -a commands=(\n";
    for (const CommandListEntry& command : commands) {
        const std::string description = CLI::detail::find_and_replace(command.description, ":", "\\:");
        script += fmt::format("        {}\n", inQuotes(command.name + ":" + description));
    }
    script += R"(    )
    if [[ $words[2] != -* ]]; then
        if ((CURRENT == 2)); then _describe command commands; return; fi
        command=$words[2]
        shift words
        ((CURRENT--))
    fi
    case $command in
)";
    for (const CommandListEntry& command : commands) {
        script += fmt::format("        {}) _arguments", command.name);
        int arguments = 0;
        for (const FlagEntry& flag : command.flags) {
            for (const std::string& name : flag.names)
                script += fmt::format(" \\\n            {}", zshFlag(flag, name));
            if (!flag.names.empty()) continue;
            const std::string place = flag.takesMany ? "*" : std::to_string(++arguments);
            script += fmt::format(" \\\n            {}",
                                  inQuotes(fmt::format("{}:{}:{}", place, flag.value, zshAction(flag))));
        }
        script += " ;;\n";
    }
    return script +
           "    esac\n}\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then _terrane \"$@\"; "
           "else compdef _terrane terrane; fi\n";
}

std::string fishCompletion(const CommandList& list) {
    const Commands& commands = list.commands;
    std::string script(kFishBegin);
    script += "complete -c terrane -f\n";
    const std::string names = joined(commandNames(commands));
    const std::string none = fmt::format("not __fish_seen_subcommand_from {}", names);
    script += fmt::format("complete -c terrane -n {} -l version -d 'Print the version'\n", inQuotes(none));
    for (const CommandListEntry& command : commands) {
        script += fmt::format("complete -c terrane -n {} -a {} -d {}\n", inQuotes(none), command.name,
                              inQuotes(command.description));
    }
    for (const CommandListEntry& command : commands) {
        const std::string named = "__fish_seen_subcommand_from " + command.name;
        const bool isDefault = command.name == list.defaultCommand;
        const std::string condition = isDefault ? fmt::format("{}; or {}", named, none) : named;
        for (const FlagEntry& flag : command.flags) {
            if (!flag.names.empty()) {
                script += fishFlag(flag, condition);
            } else if (flag.takesWorld()) {
                script += fmt::format("complete -c terrane -n {} -F -a '(__terrane_worlds)'\n",
                                      inQuotes(condition));
            } else if (flag.takesFile()) {
                script += fmt::format("complete -c terrane -n {} -F\n", inQuotes(condition));
            } else {
                script += fmt::format("complete -c terrane -n {} -a {}\n", inQuotes(condition),
                                      inQuotes(joined(flag.valueNames)));
            }
        }
    }
    return script;
}

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
