// The limit on open files, and so on connections, of this process. Called at startup.
#pragma once

namespace terrane::app {

// Raises the soft limit to the hard limit, which needs no privileges.
void raiseOpenFileLimit();

}  // namespace terrane::app
