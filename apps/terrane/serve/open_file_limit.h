// How many files, and so connections, this process may have open. Called while a program starts.
#pragma once

namespace terrane::app {

// As many as the system lets it without asking anybody.
void raiseOpenFileLimit();

}  // namespace terrane::app
