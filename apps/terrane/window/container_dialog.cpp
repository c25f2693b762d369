#include "apps/terrane/window/container_dialog.h"

#include <glm/geometric.hpp>

#include "terrane/game/container.h"

namespace terrane::app {

bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes) {
    const glm::dvec3 middle(block.x + 0.5, block.y + 0.5, block.z + 0.5);
    return glm::distance(middle, eyes) <= game::kReach + 1 &&
           game::isContainer(session.world(), session.blocks(), block);
}

base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr) {
    auto items = TERRANE_TRY(game::itemsOf(session.world(), session.blocks(), block));
    const auto click = drawContainer(screen, items, looks, tr);
    world::BlockId inHand = hotbar.block();
    if (!click || !game::clickSlot(items, session.blocks(), *click, inHand)) return {};
    game::takeInHand(hotbar, inHand);
    game::putItems(session, game::kLocalPlayer, block, items);
    return {};
}

}  // namespace terrane::app
