// A game on a server as the window shows it: chat, the other players with their names, the list of players,
// and how the connection is. Used on the thread of the session.
#pragma once

#include <optional>
#include <string>

#include "apps/terrane/window/chat_view.h"
#include "apps/terrane/window/notices.h"
#include "apps/terrane/window/other_players.h"
#include "apps/terrane/window/play_settings.h"
#include "apps/terrane/window/remote_play.h"

namespace terrane::app {

struct RemoteView {
    RemotePlay* play = nullptr;  // null: the world is the player's own
    ChatView chat;
    OtherPlayers others;
    bool showsPlayers = false;
    net::ClientLink::Stage stage = net::ClientLink::Stage::Joined;  // as of the last frame
    double nextList = 0;    // when the list of players is asked for again
    std::string endReason;  // why the server sent the player away; empty where it did not
};

struct RemoteStep {
    std::optional<world::Pose> correction;  // the server wants the player there
    bool hasEnded = false;                  // RemoteView::endReason tells why
};

// Once a frame, after the player moved: sends and takes in what there is. `seconds`: since the start. Call it
// where there is a server.
RemoteStep advanceRemote(RemoteView& remote, const world::Pose& pose, const PlaySettings& settings,
                         double seconds, Notices& notices, const Texts& tr);

// Chat, and the list of players where it is shown. True: a line was entered or given up.
bool drawRemoteTexts(const Screen& screen, RemoteView& remote, double seconds, const Texts& tr);

}  // namespace terrane::app
