// What the window's loop gives to the tools for building.
#include "apps/terrane/window/game.h"

namespace terrane::app {

BuildView Game::buildView() const {
    return {.session = parts_.session,
            .tr = tr_,
            .pose = player_.pose(),
            .body = player_.body(),
            .hand = interaction_.block(),
            .shift = withShift_,
            .control = withControl_};
}

bool Game::openSign() {
    const auto& target = interaction_.target();
    return target && building_.openSign(target->block, buildView());
}

// The cursor is free while something is typed or chosen.
void Game::drawBuilding(const Screen& screen) {
    if (!isAbove_) building_.draw(screen, camera(), buildView(), seconds_);
    if (auto message = building_.takeMessage()) say(std::move(*message));
    const bool asks = building_.isAsking();
    if (asks != std::exchange(wasAsking_, asks)) capture(!asks);
}

}  // namespace terrane::app
