#include "terrane/net/server/server_console.h"

#include <charconv>
#include <cmath>
#include <span>

#include "terrane/base/names.h"
#include "terrane/base/text.h"
#include "terrane/net/server/server.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_history.h"
#include "terrane/net/server/server_players.h"
#include "terrane/net/wire/security.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {
namespace {

using Words = std::span<const std::string>;

struct ConsoleCommand {
    std::string_view name, arguments, help;
    std::size_t minArguments, maxArguments;
    std::string (*run)(ServerState&, Words, CommandFrom);
};

constexpr std::size_t kAny = 1000;

template <class Number>
std::optional<Number> numberFrom(const std::string& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::string joined(Words words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::string unknownPlayer(const std::string& name) {
    return fmt::format("no player called {} has ever joined", name);
}

std::string sayLine(ServerClients& clients, Words words) {
    broadcastChat(clients, {}, joined(words));
    return "said";
}

std::string list(const ServerClients& clients) {
    std::string text = fmt::format("{} of {} players", clients.playing.size(), clients.settings.maxPlayers);
    forEachPlaying(clients, [&](const ServerClient& client) {
        const auto place = poseOf(client.pose).position;
        text += fmt::format("\n{} at {:.0f} {:.0f} {:.0f}, {} ms{}", client.name, place.x, place.y, place.z,
                            client.latency ? client.latency->count() : 0,
                            client.role == game::Role::Operator ? ", operator"
                            : client.role == game::Role::Guest  ? ", guest"
                                                                : "");
    });
    forEachElsewhere(clients, [&](const KnownPlayer& other, const PlayerAt&) {
        text += fmt::format("\n{} on another server", other.name);
    });
    return text;
}

std::string kick(ServerClients& clients, Words words) {
    ServerClient* client = playingClient(clients, std::string_view(words[0]));
    if (!client) return fmt::format("{} is not online", words[0]);
    const std::string reason = joined(words.subspan(1));
    refuse(clients, *client, Refusal::Kicked,
           reason.empty() ? "you were kicked" : "you were kicked: " + reason);
    return words[0] + " is sent away";
}

std::string ban(ServerClients& clients, Words words) {
    const KnownPlayer* player = clients.known.byName(words[0]);
    if (!player) return unknownPlayer(words[0]);
    std::string reason = plainText(joined(words.subspan(1)), kMaxReasonBytes);
    if (reason.empty()) reason = "no reason given";
    clients.known.setBan(player->id, reason);
    if (ServerClient* client = playingClient(clients, player->id))
        refuse(clients, *client, Refusal::Banned, banText(reason));
    return player->name + " is banned";
}

std::string unban(KnownPlayers& players, Words words) {
    const KnownPlayer* player = players.byName(words[0]);
    if (!player) return unknownPlayer(words[0]);
    if (player->ban.empty()) return player->name + " is not banned";
    players.setBan(player->id, {});
    return player->name + " may come again";
}

std::string setRole(ServerClients& clients, game::Permissions& permissions, const std::string& name,
                    game::Role role) {
    const std::string_view what = role == game::Role::Operator ? "an operator"
                                  : role == game::Role::Guest  ? "a guest, who changes no blocks,"
                                                               : "a player";
    const KnownPlayer* player = clients.known.byName(name);
    if (!player) return unknownPlayer(name);
    clients.known.setRole(player->id, role);
    permissions.roles[player->id] = role;
    if (ServerClient* client = playingClient(clients, player->id)) {
        client->role = role;
        send(*client, RoleChanged{role});
        say(*client, fmt::format("you are {} now", what));
    }
    return fmt::format("{} is {} now", player->name, what);
}

// Parses two corners, in any order.
std::optional<game::ColumnArea> areaFrom(Words words) {
    std::array<std::int32_t, 4> v{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto number = numberFrom<std::int32_t>(words[k]);
        if (!number) return std::nullopt;
        v[k] = *number;
    }
    return game::ColumnArea{std::min(v[0], v[2]), std::min(v[1], v[3]), std::max(v[0], v[2]),
                            std::max(v[1], v[3])};
}

std::string claim(KnownPlayers& players, game::Session& session, Words words) {
    const auto area = areaFrom(words.subspan(1));
    if (!area) return "the corners are four whole numbers: X0 Y0 X1 Y1";
    const auto claimName = newName(words[0]);
    if (!claimName) return claimName.error().message;
    for (const game::Claim& other : players.claims().all())
        if (other.name != *claimName && base::isConfusable(other.name, *claimName))
            return fmt::format("the name {} looks like that of the claim {}", *claimName, other.name);
    game::Claim made{*claimName, *area, game::kNoPlayer, {}};
    for (const std::string& name : words.subspan(5)) {
        const KnownPlayer* player = players.byName(name);
        if (!player) return unknownPlayer(name);
        if (made.owner == game::kNoPlayer)
            made.owner = player->id;
        else
            made.members.push_back(player->id);
    }
    if (const auto added = players.addClaim(made); !added) return added.error().message;
    session.permissions.claims = players.claims();
    session.events.claim.notify({made, true});
    return fmt::format("{} is claimed for {}", *claimName, words[5]);
}

std::string unclaim(KnownPlayers& players, game::Session& session, Words words) {
    const game::Claim* found = players.claims().find(words[0]);
    if (!found) found = players.claims().find(base::normalizedName(words[0]));
    if (!found) return fmt::format("there is no claim {}", words[0]);
    const game::Claim removed = *found;
    players.removeClaim(removed.name);
    session.permissions.claims = players.claims();
    session.events.claim.notify({removed, false});
    return fmt::format("the claim {} is gone", words[0]);
}

std::string claimList(const KnownPlayers& players) {
    std::string text = fmt::format("claims: {}", players.claims().all().size());
    for (const game::Claim& one : players.claims().all()) {
        const KnownPlayer* owner = players.byId(one.owner);
        text += fmt::format("\n{} {} {} {} {} {}", one.name, one.area.x0, one.area.y0, one.area.x1,
                            one.area.y1, owner ? owner->name : "nobody");
    }
    return text;
}

std::string rollbackLine(ServerHistory& history, const KnownPlayers& players, Time now, Words words) {
    EditFilter filter;
    if (words[0] != "*") {
        const KnownPlayer* player = players.byName(words[0]);
        if (!player) return unknownPlayer(words[0]);
        filter.player = player->id;
    }
    const auto minutes = numberFrom<double>(words[1]);
    if (!minutes || !(*minutes > 0) || *minutes > 1e8)
        return fmt::format("{} is no number of minutes", words[1]);
    if (words.size() == 6) {
        filter.area = areaFrom(words.subspan(2));
        if (!filter.area) return "the corners are four whole numbers: X0 Y0 X1 Y1";
    } else if (words.size() != 2) {
        return "an area is four whole numbers: X0 Y0 X1 Y1";
    }
    const auto count = startRollback(history, filter, static_cast<std::int64_t>(*minutes * 60000), now);
    return count ? fmt::format("rolling back {}; what changed since stays", base::counted(*count, "block"))
                 : count.error().message;
}

std::string mark(ServerPlaces& places, Words words) {
    world::Pose pose;
    for (int k = 0; k < 3; ++k) {
        const auto number = numberFrom<double>(words[static_cast<std::size_t>(k)]);
        if (!number) return "a place is three numbers and a name: X Y Z NAME; in the chat a name alone";
        // Also of z, since messages hold no more.
        if (!(std::abs(*number) <= kMaxPosePosition / kPoseSteps)) return "this place is not in the world";
        pose.position[k] = *number;
    }
    if (!world::isInWorld(world::chunkOf(pose.position))) return "this place is not in the world";
    return markPlace(places, joined(words.subspan(3)), pose);
}

std::string setTime(ServerClients& clients, game::DayClock& clock, Words words) {
    const auto time = numberFrom<double>(words[0]);
    if (!time || !(*time >= 0 && *time < 1)) return "a time of day is 0 (midnight) to below 1; 0.5 is noon";
    setTimeHere(clients, clock, *time);
    if (clients.shared) clients.shared->publishTime(*time);
    return "the time is set";
}

std::string setPassword(std::string& hash, ServerRecords& records, Words words) {
    if (words[0] == "off") {
        hash.clear();
    } else {
        const std::size_t size = words[0].size();
        if (size == 0 || size > kMaxPasswordBytes || !isPlainText(words[0]))
            return fmt::format("a password has 1 to {} bytes of text", kMaxPasswordBytes);
        auto made = passwordHash(words[0]);
        if (!made) return made.error().message;
        hash = std::move(*made);
    }
    records.setText(kPasswordText, hash);
    return hash.empty() ? "no password is needed" : "the password is set";
}

std::string save(ServerState& server) {
    const auto saved = saveEverything(server);
    return saved ? "saved" : saved.error().message;
}

using Server = ServerState;

// Each hands its function the parts of the server that it needs.
constexpr ConsoleCommand kCommands[] = {
    {"help", "", "this list", 0, 0, [](Server&, Words, CommandFrom) { return consoleHelp(); }},
    {"list", "", "lists players with position, latency and role", 0, 0,
     [](Server& s, Words, CommandFrom) { return list(s.clients); }},
    {"say", "TEXT", "sends a line to all players", 1, kAny,
     [](Server& s, Words w, CommandFrom) { return sayLine(s.clients, w); }},
    {"kick", "PLAYER [REASON]", "disconnects a player", 1, kAny,
     [](Server& s, Words w, CommandFrom) { return kick(s.clients, w); }},
    {"ban", "PLAYER [REASON]", "disconnects a player and refuses further logins", 1, kAny,
     [](Server& s, Words w, CommandFrom) { return ban(s.clients, w); }},
    {"unban", "PLAYER", "allows a banned player to log in again", 1, 1,
     [](Server& s, Words w, CommandFrom) { return unban(s.clients.known, w); }},
    {"op", "PLAYER", "makes a player an operator: builds everywhere, gives commands", 1, 1,
     [](Server& s, Words w, CommandFrom) {
         return setRole(s.clients, s.session.permissions, w[0], game::Role::Operator);
     }},
    {"deop", "PLAYER", "makes an operator or guest an ordinary player", 1, 1,
     [](Server& s, Words w, CommandFrom) {
         return setRole(s.clients, s.session.permissions, w[0], game::Role::Player);
     }},
    {"guest", "PLAYER", "makes a player a guest: looks and chats, changes no blocks", 1, 1,
     [](Server& s, Words w, CommandFrom) {
         return setRole(s.clients, s.session.permissions, w[0], game::Role::Guest);
     }},
    {"claim", "NAME X0 Y0 X1 Y1 OWNER [MEMBER…]", "columns where only these players build", 6, kAny,
     [](Server& s, Words w, CommandFrom) { return claim(s.clients.known, s.session, w); }},
    {"unclaim", "NAME", "ends a claim", 1, 1,
     [](Server& s, Words w, CommandFrom) { return unclaim(s.clients.known, s.session, w); }},
    {"claims", "", "all claims", 0, 0,
     [](Server& s, Words, CommandFrom) { return claimList(s.clients.known); }},
    {"rollback", "PLAYER|* MINUTES [X0 Y0 X1 Y1]", "reverts the edits of a player, or of all with *", 2, 6,
     [](Server& s, Words w, CommandFrom) {
         return rollbackLine(s.history, s.clients.known, s.clients.now, w);
     }},
    {"mark", "X Y Z NAME", "names a place on maps; players name their own position: /mark NAME", 4, kAny,
     [](Server& s, Words w, CommandFrom) { return mark(s.places, w); }},
    {"unmark", "NAME", "removes a named place", 1, kAny,
     [](Server& s, Words w, CommandFrom) { return unmarkPlace(s.places, joined(w)); }},
    {"marks", "", "lists all named places", 0, 0,
     [](Server& s, Words, CommandFrom) { return placeList(s.places); }},
    {"time", "0…1", "sets the time of day: 0 midnight, 0.5 noon", 1, 1,
     [](Server& s, Words w, CommandFrom) { return setTime(s.clients, s.session.clock, w); }},
    {"password", "PASSWORD|off", "sets or removes the password for joining", 1, 1,
     [](Server& s, Words w, CommandFrom) { return setPassword(s.password.hash, s.history.records, w); }},
    {"save", "", "saves all changes now; the server also saves every five seconds", 0, 0,
     [](Server& s, Words, CommandFrom) { return save(s); }},
    {"backup", "NAME|FILE", "writes a copy of the world as of now, while the server runs", 1, 1,
     [](Server& s, Words w, CommandFrom from) { return startBackup(s, w[0], from); }},
    {"stop", "", "saves and ends the server", 0, 0,
     [](Server& s, Words, CommandFrom) {
         s.isStopping = true;
         return std::string("stopping");
     }},
};

std::vector<std::string> wordsOf(std::string_view line) {
    std::vector<std::string> words;
    while (true) {
        while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
        if (line.empty()) return words;
        const bool isQuoted = line.front() == '"';
        if (isQuoted) line.remove_prefix(1);
        const std::size_t end = std::min(line.find(isQuoted ? '"' : ' '), line.size());
        words.emplace_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
}

}  // namespace

std::string runConsoleLine(ServerState& server, std::string_view line, CommandFrom from) {
    const std::vector<std::string> words = wordsOf(line);
    if (words.empty()) return {};
    for (const ConsoleCommand& command : kCommands) {
        if (command.name != words[0]) continue;
        const std::size_t count = words.size() - 1;
        if (count < command.minArguments || count > command.maxArguments)
            return fmt::format("expected: {} {}", command.name, command.arguments);
        return command.run(server, Words(words).subspan(1), from);
    }
    return fmt::format("there is no command {}: help lists them", words[0]);
}

std::string consoleHelp() {
    std::string text;
    for (const ConsoleCommand& command : kCommands)
        text += fmt::format("{}{}{}{}: {}", text.empty() ? "" : "\n", command.name,
                            command.arguments.empty() ? "" : " ", command.arguments, command.help);
    return text;
}

}  // namespace terrane::net
