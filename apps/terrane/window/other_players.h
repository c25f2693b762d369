// The other players of a server as figures with names. Updated once per frame.
#pragma once

#include <chrono>
#include <map>
#include <vector>

#include "apps/terrane/window/name_tags.h"
#include "terrane/game/figure_motion.h"
#include "terrane/net/client_world.h"

namespace terrane::app {

struct OtherPlayers {
    std::vector<world::Figure> figures;
    std::vector<NameTag> names;  // of the figures

    struct Known {
        game::FigureMotion motion;
        game::PlayerId id;
        std::uint64_t moves, swings;
    };
    std::map<std::uint16_t, Known> known;  // by slot
};

void updatePlayers(OtherPlayers& others, const net::ClientWorld& world,
                   std::chrono::steady_clock::time_point now);

}  // namespace terrane::app
