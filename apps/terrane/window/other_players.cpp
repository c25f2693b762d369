#include "apps/terrane/window/other_players.h"

namespace terrane::app {

void updatePlayers(OtherPlayers& others, const net::ClientWorld& world,
                   std::chrono::steady_clock::time_point now) {
    std::erase_if(others.known, [&](const auto& entry) {
        const auto seen = world.players().find(entry.first);
        return seen == world.players().end() || seen->second.id != entry.second.id;
    });
    others.figures.clear();
    others.names.clear();
    for (const auto& [slot, player] : world.players()) {
        OtherPlayers::Known& known =
            others.known
                .try_emplace(slot, OtherPlayers::Known{game::FigureMotion(player.pose, now, player.id),
                                                       player.id, player.moves, player.swings})
                .first->second;
        if (known.moves != player.moves) known.motion.told(player.pose, now);
        if (known.swings != player.swings) known.motion.swing(now);
        known.moves = player.moves;
        known.swings = player.swings;
        others.figures.push_back(known.motion.at(now));
        others.names.push_back({player.name, others.figures.back().eyes});
    }
}

}  // namespace terrane::app
