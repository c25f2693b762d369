#include "apps/terrane/help/command_list.h"

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

}  // namespace terrane::app
