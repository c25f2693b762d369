// Settings of a server. Plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "terrane/game/permissions.h"

namespace terrane::net {

struct ServerSettings {
    std::string welcome;  // a line sent to players who join; empty: none
    std::size_t maxPlayers = 100;
    int maxViewDistance = 32;                   // radius in chunks in which a player receives edits
    std::size_t maxPlayersOfAddress = 20;       // at a time, except from this machine
    double newPlayersPerHour = 100;             // per address, except from this machine
    double maxSpeed = 120;                      // blocks per second; flying reaches 60, falling 55
    int spawnRadius = 0;                        // blocks around the spawn where new players appear
    game::Role newcomers = game::Role::Player;  // Guest: may look and chat only
    double dayMinutes = 20;
    std::size_t maxFillBlocks = 65536;         // in one command
    std::size_t maxUnsentBytes = 4 << 20;      // for a client that does not read
    std::chrono::seconds loginWithin{10};      // from connecting to joining
    std::chrono::seconds silentAfter{20};      // time without a message of a player
    std::chrono::seconds keepHistoryFor{600};  // undo steps of a player who left
};

}  // namespace terrane::net
