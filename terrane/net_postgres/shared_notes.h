// Notes that servers send each other through NOTIFY: one line of text of at most 8,000 bytes (PostgreSQL's
// limit): the server's number, a letter for the type, hexadecimal digits. Plain values and functions.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "terrane/net/sharing/shared_world.h"

namespace terrane::net_postgres {

struct EditsNote {};   // edits were appended
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
struct PasswordNote {};                      // the password changed or was removed
constexpr double kTimeSteps = 4294967296.0;  // steps per day
struct TimeNote {                            // the time of day was set
    std::uint32_t timeDay = 0;               // in steps of kTimeSteps
};
using Note = std::variant<EditsNote, ClaimsNote, PlayerNote, JoinedNote, LeftNote, LineNote, PosesNote,
                          TilesNote, PasswordNote, TimeNote, PlaceNote>;

// Maximum counts that fit one note.
constexpr std::size_t kMaxPosesInNote = 120, kMaxTilesInNote = 300;

// Whether the note reports changed rows of players, claims or the password, which must be read.
bool isOfRows(const Note& note);

std::string noteText(std::int64_t server, const Note& note);
struct ReadNote {
    std::int64_t server = 0;
    Note note;
};
// No value if the text is not a valid note: any role of the database can send one.
std::optional<ReadNote> readNote(std::string_view text);

}  // namespace terrane::net_postgres
