// What the window's loop does for a game on a server.
#include "apps/terrane/window/game.h"

namespace terrane::app {

// After the player moved.
void Game::advanceRemote() {
    if (!parts_.remote) return;
    RemotePlay& remote = *parts_.remote;
    remote.poll();
    net::ClientWorld& world = remote.world();
    const auto now = std::chrono::steady_clock::now();
    world.update(player_.pose(), settings_.graphics.viewDistance, settings_.graphics.horizon, now);
    if (const auto place = world.takeCorrection()) player_.placeAt(*place, settings_.movement);
    for (const net::ChatLine& line : world.takeChat()) hud_.chat.add(line, seconds_);
    for (const net::Decided& decided : world.takeDecided()) tellDecided(decided);
    updatePlayers(hud_.others, world, now);
    using Stage = net::ClientLink::Stage;
    const Stage stage = remote.stage();
    if (stage == std::exchange(linkStage_, stage)) return;
    if (stage == Stage::Joined) say(tr_("back on the server"));
    if (stage == Stage::Waiting) say(tr_("the connection is gone: trying again"));
    if (stage != Stage::Ended) return;
    serverReason_ = remote.reason();
    leave(true);
}

// What the server decided later than it was asked.
void Game::tellDecided(const net::Decided& decided) {
    if (const auto* result = std::get_if<game::EditResult>(&decided)) return tellRefusal(*result);
    if (const auto* outcome = std::get_if<game::BuildOutcome>(&decided))
        return say(outcomeText("changed", *outcome));
    tellTakenBack(std::get<game::TakenBack>(decided), true);
}

void Game::beginChat() {
    if (!parts_.remote) return;
    capture(false);
    hud_.chat.beginTyping();
}

void Game::drawRemote(const Screen& screen, const render::Camera& camera) {
    if (!parts_.remote) return;
    if (!hud_.isHidden && !isAbove_)
        drawNames(screen, camera, hud_.others.names, {parts_.session.world(), parts_.session.blocks()});
    if (const auto line = hud_.chat.draw(screen, tr_, seconds_)) {
        if (!line->empty()) parts_.remote->world().say(*line);
        capture(true);
    }
    if (!hud_.showsPlayers) return;
    constexpr double kAskEvery = 2;
    if (seconds_ >= std::exchange(nextList_, std::max(nextList_, seconds_))) {
        parts_.remote->askPlayers();
        nextList_ = seconds_ + kAskEvery;
    }
    if (const auto& list = parts_.remote->world().playerList()) drawPlayerList(screen, tr_, *list);
}

}  // namespace terrane::app
