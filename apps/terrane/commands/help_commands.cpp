// terrane completion and terrane man: the command line for shells and manual readers.
#include <iostream>
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/help/reference.h"
#include "terrane/base/text.h"

namespace terrane::app {

CommandEntry addCompletion(CLI::App& app) {
    struct Shell {
        const char* name;
        std::string (*script)(const CommandList&);
    };
    static constexpr std::array<Shell, 3> kShells = {
        {{"bash", bashCompletion}, {"zsh", zshCompletion}, {"fish", fishCompletion}}};
    auto shell = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("completion", "Print a script that completes commands in a shell");
    command->add_option("shell", *shell, "The shell: bash, zsh, fish")->type_name("CHOICE")->required();
    return {command, [shell, &app]() -> base::Result<void> {
                for (const Shell& known : kShells) {
                    if (known.name != *shell) continue;
                    std::cout << known.script(commandList(app, defaultCommand()));
                    return {};
                }
                std::vector<std::string> names;
                for (const Shell& known : kShells) names.emplace_back(known.name);
                return base::fail("completion: {}", base::expectedOneOf(names, *shell));
            }};
}

CommandEntry addMan(CLI::App& app) {
    CLI::App* command = app.add_subcommand("man", "Print the manual page (roff)");
    return {command, [&app]() -> base::Result<void> {
                std::cout << manPage(commandList(app, defaultCommand()), TERRANE_VERSION);
                return {};
            }};
}

}  // namespace terrane::app
