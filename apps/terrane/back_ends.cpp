#include "apps/terrane/back_ends.h"

#include "apps/terrane/options.h"

namespace terrane::app {

void addBackendOption(CLI::App& command, Backend& backend, const std::string& description) {
    addChoice<Backend>(command, "--backend", backend,
                       {{"auto", Backend::Auto}, {"cpu", Backend::Cpu}, {"gpu", Backend::Gpu}}, description);
}

}  // namespace terrane::app
