// terrane work in a build without PostgreSQL.
#include "apps/terrane/commands/commands.h"

namespace terrane::app {

CommandEntry addWork(CLI::App& app) {
    CLI::App* command = app.add_subcommand("work", "Not in this build, which has no PostgreSQL");
    command->allow_extras();
    return {command, []() -> base::Result<void> {
                return base::fail(base::ErrorCode::Unsupported, "work: this build has no PostgreSQL");
            }};
}

}  // namespace terrane::app
