// What the owner of a server decides. Plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "terrane/game/permissions.h"

namespace terrane::net {

struct ServerSettings {
    std::string welcome;  // a line for who joins; empty: none
    std::size_t maxPlayers = 100;
    int maxViewDistance = 32;                   // chunks around a player whose edits it is told
    std::size_t maxPlayersOfAddress = 20;       // at a time, this machine's own apart
    double newPlayersPerHour = 100;             // of one address, but for this machine's own
    double maxSpeed = 120;                      // blocks a second; flying takes 60, falling 78
    int spawnRadius = 0;                        // newcomers appear so many blocks around the spawn
    game::Role newcomers = game::Role::Player;  // Guest: they look and talk
    double dayMinutes = 20;
    std::size_t maxFillBlocks = 65536;         // in one command
    std::size_t maxUnsentBytes = 4 << 20;      // of a client that does not read
    std::chrono::seconds loginWithin{10};      // from the connection to the world
    std::chrono::seconds silentAfter{20};      // nothing came from a player
    std::chrono::seconds keepHistoryFor{600};  // of undo, of a player who left
};

}  // namespace terrane::net
