// The program: parses the command line, runs one command and reports its result.
#pragma once

namespace terrane::app {

// Exit codes: 0 success; 1 a save is damaged (check), something could not be read (copy, import) or a
// measurement failed (bench); 2 bad input or a missing requirement.
int runProgram(int argc, char** argv);

}  // namespace terrane::app
