// The chat, and the window's view of a game on a server: other players with names, the list of players, and
// the state of the connection. Used on the thread of the session.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/window/game/remote_play.h"
#include "apps/terrane/window/hud/chat_view.h"
#include "apps/terrane/window/hud/name_tags.h"
#include "apps/terrane/window/hud/notices.h"
#include "apps/terrane/window/settings/play_settings.h"
#include "terrane/game/figure_motion.h"
#include "terrane/net/client/client_world.h"

namespace terrane::app {

// The other players of a server as figures with names. Updated once per frame.
struct OtherPlayers {
    std::vector<world::Figure> figures;
    std::vector<NameTag> names;  // of the figures

    struct Known {
        game::FigureMotion motion;
        game::PlayerId id;
        std::uint64_t moves, swings;
    };
    std::map<std::uint16_t, Known> known;  // by slot
};

void updatePlayers(OtherPlayers& others, const net::ClientWorld& world,
                   std::chrono::steady_clock::time_point now);

struct RemoteView {
    RemotePlay* play = nullptr;  // null: the world is the player's own
    ChatView chat;
    OtherPlayers others;
    bool showsPlayers = false;
    net::ClientLink::Stage stage = net::ClientLink::Stage::Joined;  // in the last frame
    double nextList = 0;    // time of the next request for the list of players
    std::string endReason;  // reason of a disconnect by the server, else empty
};

struct RemoteStep {
    std::optional<world::Pose> correction;  // pose that the server demands
    bool hasEnded = false;                  // see RemoteView::endReason
};

// Call once per frame after the player moved, if there is a server: sends and receives. `seconds`: since the
// start.
RemoteStep advanceRemote(RemoteView& remote, const world::Pose& pose, const PlaySettings& settings,
                         double seconds, Notices& notices, const Texts& tr);

// Draws chat, and the list of players if it is shown. A line goes to the server, or in the player's own world
// to the rules and commands of the session. True if a line was entered or cancelled.
bool drawChat(OverlayLayout& layout, RemoteView& remote, game::Session& session, double seconds,
              const Texts& tr);

}  // namespace terrane::app
