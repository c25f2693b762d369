#include "apps/terrane/window/game/remote_view.h"

#include <chrono>
#include <utility>
#include <variant>

#include "apps/terrane/window/hud/selection_tool.h"
#include "apps/terrane/window/text.h"

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
        if (known.moves != player.moves) known.motion.addPose(player.pose, now);
        if (known.swings != player.swings) known.motion.swing(now);
        known.moves = player.moves;
        known.swings = player.swings;
        others.figures.push_back(known.motion.at(now));
        others.names.push_back({player.name, others.figures.back().eyes});
    }
}

namespace {

using Stage = net::ClientLink::Stage;

// The text about a server's late answer to a command.
std::string textOf(const net::Decided& decided, const Texts& tr) {
    if (const auto* result = std::get_if<game::EditResult>(&decided)) return refusalText(*result, tr);
    if (const auto* outcome = std::get_if<game::BuildOutcome>(&decided))
        return outcomeText("changed", *outcome);
    const auto& taken = std::get<net::DecidedTakeBack>(decided);
    return takenBackText(taken.result, taken.way, tr);
}

void tellStage(Stage stage, Notices& notices, const Texts& tr) {
    if (stage == Stage::Joined) notices.say(tr("reconnected"));
    if (stage == Stage::Waiting) notices.say(tr("connection lost: reconnecting"));
}

}  // namespace

RemoteStep advanceRemote(RemoteView& remote, const world::Pose& pose, const PlaySettings& settings,
                         double seconds, Notices& notices, const Texts& tr) {
    RemotePlay& play = *remote.play;
    play.poll();
    net::ClientWorld& world = play.world();
    const auto now = std::chrono::steady_clock::now();
    world.update(pose, settings.graphics.viewDistance, settings.graphics.horizon, now);
    RemoteStep step{.correction = world.popCorrection()};
    for (const net::ChatLine& line : world.popChat()) remote.chat.add(line, seconds);
    for (const net::Decided& decided : world.popDecided()) notices.say(textOf(decided, tr));
    updatePlayers(remote.others, world, now);
    const Stage stage = play.stage();
    if (stage == std::exchange(remote.stage, stage)) return step;
    tellStage(stage, notices, tr);
    step.hasEnded = stage == Stage::Ended;
    if (step.hasEnded) remote.endReason = play.reason();
    return step;
}

namespace {

// A line that is typed in the player's own world.
void sayHere(ChatView& chat, game::Session& session, const std::string& line, double seconds,
             const Texts& tr) {
    if (!line.starts_with('/')) {
        if (!game::mayChat(session, game::kLocalPlayer, line)) return;
        chat.add({{}, line}, seconds);
        return session.events.chat.notify({game::kLocalPlayer, line});
    }
    if (game::runChatCommand(session, game::kLocalPlayer, std::string_view(line).substr(1))) return;
    const std::string help = game::chatHelp(session.chatCommands);
    chat.add({{}, help.empty() ? tr("this world has no commands") : help}, seconds);
}

}  // namespace

bool drawChat(OverlayLayout& layout, RemoteView& remote, game::Session& session, double seconds,
              const Texts& tr) {
    constexpr double kAskEvery = 2;
    const auto line = remote.chat.draw(layout, tr, seconds);
    if (line && !line->empty() && remote.play) remote.play->world().say(*line);
    if (line && !line->empty() && !remote.play) sayHere(remote.chat, session, *line, seconds, tr);
    if (!remote.play || !remote.showsPlayers) return line.has_value();
    if (seconds >= remote.nextList) {
        remote.play->askPlayers();
        remote.nextList = seconds + kAskEvery;
    }
    if (const auto& list = remote.play->world().playerList()) drawPlayerList(layout, tr, *list);
    return line.has_value();
}

}  // namespace terrane::app
