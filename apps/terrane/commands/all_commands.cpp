#include "apps/terrane/commands/commands.h"

namespace terrane::app {

std::vector<CommandEntry> addCommands(CLI::App& app) {
    return {addPlay(app),       addRender(app), addRecord(app), addFlightBench(app), addGenerate(app),
            addMap(app),        addDump(app),   addCheck(app),  addCopy(app),        addBackup(app),
            addImport(app),     addExport(app), addWork(app),   addServe(app),       addHistory(app),
            addBots(app),       addBlocks(app), addPacks(app),  addInfo(app),        addBench(app),
            addCompletion(app), addMan(app)};
}

const char* defaultCommand() {
    return "play";
}

}  // namespace terrane::app
