#include "apps/terrane/machine_name.h"

#include <fmt/format.h>
#include <unistd.h>

namespace terrane::app {

std::string machineName() {
    char name[256] = "";
    return ::gethostname(name, sizeof name - 1) == 0 && name[0] != '\0' ? name : "localhost";
}

std::string processName() {
    return fmt::format("{} process {}", machineName(), ::getpid());
}

}  // namespace terrane::app
