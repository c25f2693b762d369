#include "apps/terrane/maps/player_list.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "apps/terrane/maps/site_parts.h"
#include "terrane/net/server_clients.h"

namespace terrane::app {
namespace {

constexpr int kRoof = 3;  // blocks

}  // namespace

std::vector<web::NamedPlace> PlayerList::now() {
    std::vector<web::NamedPlace> players;
    if (shown_ == ShownPlayers::None) return players;
    const std::unordered_map<game::PlayerId, Known> before = std::exchange(known_, {});
    const auto add = [&](game::PlayerId id, const std::string& name, const world::Pose& pose) {
        const world::ChunkPos chunk = world::chunkOf(pose.position);
        const auto former = before.find(id);
        const bool isNear = former != before.end() && world::chunkDistance(former->second.chunk, chunk) <= 1;
        Known known{chunk, !isNear || former->second.isHidden};
        if (shown_ == ShownPlayers::All)
            known.isHidden = false;
        else if (const auto isHidden = isUnderGround(pose))
            known.isHidden = *isHidden;
        else if (isNear)
            known.chunk = former->second.chunk;
        if (!known.isHidden) players.push_back(namedPlace(name, pose));
        known_[id] = known;
    };
    net::forEachPlaying(server_, [&](const net::ServerClient& client) {
        add(client.player, client.name, net::poseOf(client.pose));
    });
    for (const auto& [id, other] : server_.sharing.players) {
        const net::KnownPlayer* known = server_.people.byId(id);
        if (known && !server_.playing.contains(id)) add(id, known->name, net::poseOf(other.at.pose));
    }
    return players;
}

std::optional<bool> PlayerList::isUnderGround(const world::Pose& pose) const {
    game::Session& session = server_.session;
    if (!session.pipeline().maybeLoadChunkAt(world::chunkOf(pose.position))) return std::nullopt;
    const world::BlockPos eyes = world::blockOf(pose.position);
    int roof = 0;
    for (std::int32_t z = std::max(eyes.z + 1, 0); z < world::kChunkHeight && roof < kRoof; ++z)
        roof += session.blocks().type(session.world().block({eyes.x, eyes.y, z})).opaqueCube;
    return roof >= kRoof;
}

}  // namespace terrane::app
