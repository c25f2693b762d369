#include "apps/terrane/window/building_tools.h"

#include <glm/geometric.hpp>
#include <utility>

#include "apps/terrane/window/sign_text.h"

namespace terrane::app {

bool BuildingTools::onKey(Key key, const BuildView& view) {
    if (!sign_) return selection_.onKey(key, view);
    sign_->onKey(key);
    return true;
}

bool BuildingTools::openSign(world::BlockPos pos, const BuildView& view) {
    const world::World& world = view.session.world();
    if (!world::holdsText(view.session.blocks().type(world.block(pos)))) return false;
    const world::BlockEntityData* data = world.blockEntityData(pos);
    const auto text = data ? world::decodeSign(*data) : base::Result<world::SignText>(world::SignText{});
    sign_.emplace(pos, text ? *text : world::SignText{});
    return true;
}

bool BuildingTools::close() {
    if (!sign_) return selection_.close();
    sign_.reset();
    return true;
}

void BuildingTools::draw(const Screen& screen, const render::Camera& camera, const BuildView& view,
                         double seconds) {
    drawSigns(screen, camera, view.session,
              signs_.at(seconds, [&] { return signsNear(view.session, camera.position); }));
    selection_.draw(screen, camera, view);
    if (sign_) drawSign(screen, view);
}

// Draws the open sign; closes it if it is gone or out of reach.
void BuildingTools::drawSign(const Screen& screen, const BuildView& view) {
    const world::BlockPos pos = sign_->sign();
    const glm::dvec3 middle(pos.x + 0.5, pos.y + 0.5, pos.z + 0.5);
    const bool isNear = glm::distance(middle, view.pose.position) <= game::kReach + 1;
    const bool isThere = world::holdsText(view.session.blocks().type(view.session.world().block(pos)));
    const auto choice = sign_->draw(screen, view.tr);
    if (choice == SignDialog::Choice::Done) {
        const auto good = world::checkSign(sign_->text());
        if (!good)
            message_ = good.error().message;
        else
            view.session.edit({game::kLocalPlayer, pos,
                               world::SetEntityData{world::encodeSign(sign_->text())},
                               view.session.world().block(pos)});
    }
    if (choice || !isNear || !isThere) sign_.reset();
}

std::optional<std::string> BuildingTools::takeMessage() {
    if (message_) return std::exchange(message_, std::nullopt);
    return selection_.takeMessage();
}

}  // namespace terrane::app
