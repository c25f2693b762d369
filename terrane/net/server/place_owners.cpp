#include "terrane/net/server/place_owners.h"

#include <algorithm>

namespace terrane::net {

std::string placesTextOf(game::PlayerId player) {
    return fmt::format("places of {}", player);
}

base::Result<std::vector<game::Place>> PlaceOwners::placesOf(game::PlayerId player,
                                                             const std::vector<game::Place>& all) {
    auto known = known_.find(player);
    if (known == known_.end()) {
        const auto text = TERRANE_TRY(records_->text(placesTextOf(player)));
        known = known_.emplace(player, game::placesFrom(text)).first;
    }
    std::vector<game::Place> there;
    for (const game::Place& place : known->second)
        if (std::ranges::find(all, place) != all.end()) there.push_back(place);
    return there;
}

void PlaceOwners::set(game::PlayerId player, const std::vector<game::Place>& places) {
    known_[player] = places;
    records_->setText(placesTextOf(player), game::textOf(places));
}

}  // namespace terrane::net
