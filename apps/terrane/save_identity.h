// Which world a save is of, against what the command line asks for.
#pragma once

#include "apps/terrane/option_values.h"
#include "terrane/store/save_file.h"

namespace terrane::app {

store::WorldIdentity identityOf(const WorldOptions& options);

struct SaveRequest {
    std::filesystem::path path;
    bool recreate = false;
};

// How a save is opened for `options`, which outlive the result: where there is one, the options take its seed
// and generator. It is refused, and left as it is, where the command line gives others, or where this program
// lacks the generator, or has another version of it and does not make the world anew.
store::SaveAccess accessTo(const SaveRequest& request, WorldOptions& options, const CLI::App& command);

}  // namespace terrane::app
