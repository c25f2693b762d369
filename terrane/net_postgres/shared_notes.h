// What servers tell each other through NOTIFY: a line of text each, of at most 8,000 bytes (PostgreSQL's
// limit). A server's number, then a letter and hexadecimal digits. Plain values and functions.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "terrane/net/shared_world.h"

namespace terrane::net_postgres {

struct EditsNote {};   // the history is longer
struct ClaimsNote {};  // claims changed
struct PlayerNote {    // a player's row is new or changed
    game::PlayerId player = 0;
};
struct JoinedNote {
    game::PlayerId player = 0;
};
struct LeftNote {
    game::PlayerId player = 0;
};
struct LineNote {
    net::SharedLine line;
};
struct PosesNote {
    std::vector<net::OtherPlayer> players;
};
struct TilesNote {
    std::vector<world::ChunkPos> tiles;
};
struct PlaceNote {
    net::PlaceChange change;
};
struct PasswordNote {};                      // it is another one, or none
constexpr double kTimeSteps = 4294967296.0;  // a day
struct TimeNote {                            // somebody set the time of day
    std::uint32_t timeDay = 0;               // in steps of kTimeSteps
};
using Note = std::variant<EditsNote, ClaimsNote, PlayerNote, JoinedNote, LeftNote, LineNote, PosesNote,
                          TilesNote, PasswordNote, TimeNote, PlaceNote>;

// At most so many fit one note.
constexpr std::size_t kMaxPosesInNote = 120, kMaxTilesInNote = 300;

// It says that rows of people changed, and to look at them.
bool isOfRows(const Note& note);

std::string noteText(std::int64_t server, const Note& note);
struct ReadNote {
    std::int64_t server = 0;
    Note note;
};
// Nothing where it is no note: anybody with a role in the database can send one.
std::optional<ReadNote> readNote(std::string_view text);

}  // namespace terrane::net_postgres
