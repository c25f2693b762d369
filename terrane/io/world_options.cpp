#include "terrane/io/world_options.h"

#include <algorithm>
#include <thread>

namespace terrane::io {

unsigned threadCount(const WorldOptions& options) {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace terrane::io
