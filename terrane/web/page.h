// The map's page, and the facts about a world that it gets. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/map/map_tile.h"
#include "terrane/store/saves/world_identity.h"

namespace terrane::web {

// A named player or place; position in blocks.
struct NamedPlace {
    std::string name;
    double x = 0, y = 0, z = 0;

    bool operator==(const NamedPlace&) const = default;
};

struct PageFacts {
    store::WorldIdentity identity;
    std::string name;  // display name of the world
    NamedPlace spawn;
    std::vector<NamedPlace> places = {};
    std::vector<std::string> layers = {};
    int minZoom = 0, maxZoom = 0;
    std::uint64_t edits = 0;                  // number of the last event of edits
    bool isLive = true;                       // served by a program, not static files
    std::optional<map::BlockRect> area = {};  // area with tiles; no value: the whole world
};
// Formats as JSON.
std::string textOf(const PageFacts& facts);
std::string textOf(const std::vector<NamedPlace>& places);
// The facts as a script for the page: world.js.
std::string scriptOf(const PageFacts& facts);

// The files of the page, except world.js.
std::span<const base::EmbeddedFile> pageFiles();
const base::EmbeddedFile* pageFile(std::string_view name);  // null if there is none
std::string_view typeOf(std::string_view fileName);         // for Content-Type

}  // namespace terrane::web
