// Commands of a build without graphics.
#include "apps/terrane/commands/commands.h"

namespace terrane::app {

std::vector<CommandEntry> addCommands(CLI::App& app) {
    return {addGenerate(app),   addMap(app),    addDump(app),   addCheck(app), addCopy(app),
            addBackup(app),     addImport(app), addExport(app), addWork(app),  addServe(app),
            addHistory(app),    addBots(app),   addBlocks(app), addPacks(app), addInfo(app),
            addCompletion(app), addMan(app)};
}

const char* defaultCommand() {
    return nullptr;
}

}  // namespace terrane::app
