// Which player named which place: a player has a share of the named places of a world. Kept in the server's
// records, a text for each player with the places that it named. On the server's thread.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/game/places.h"
#include "terrane/net/server/server_records.h"

namespace terrane::net {

// The last places are for operators: ordinary players cannot use up all of them.
constexpr std::size_t kPlacesOfOperators = 40;
static_assert(kPlacesOfOperators < game::kMaxPlaces);

// The name of a player's text in the records.
std::string placesTextOf(game::PlayerId player);

class PlaceOwners {
  public:
    // Keeps the reference.
    explicit PlaceOwners(ServerRecords& records) : records_(&records) {}

    // Those of all places that the player named and nobody has moved since. Reads the records at the first
    // call for a player, which blocks.
    [[nodiscard]] base::Result<std::vector<game::Place>> placesOf(game::PlayerId player,
                                                                  const std::vector<game::Place>& all);
    // After placesOf(): the player has these places.
    void set(game::PlayerId player, const std::vector<game::Place>& places);
    // Reads the player's text again: the player comes from another server of the world.
    void forget(game::PlayerId player) { known_.erase(player); }

  private:
    ServerRecords* records_;
    std::map<game::PlayerId, std::vector<game::Place>> known_;
};

}  // namespace terrane::net
