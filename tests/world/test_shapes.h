// Shapes for tests: with facing and halves, with arms, with another form; of quads, alone and beside boxes.
#pragma once

#include <string>

namespace terrane::world {

// In the notation of content files; blocks follow.
inline const std::string kTestShapes = R"(
[[shape]]
name = "stairs"
facing = true
half = true
boxes = [[0, 0, 0, 16, 16, 8], [0, 8, 8, 16, 16, 16]]
[[shape]]
name = "post"
boxes = [[6, 6, 0, 10, 10, 16]]
arms = [[7, 10, 6, 9, 16, 9]]
[[shape]]
name = "door"
facing = true
boxes = [[0, 0, 0, 16, 3, 16]]
other = [[0, 0, 0, 3, 16, 16]]
[[shape]]
name = "roof"
facing = true
half = true
quads = [
    { corners = [[0, 0, 0], [16, 0, 0], [16, 16, 16], [0, 16, 16]], texture = "top" },
    { corners = [[16, 16, 0], [0, 16, 0], [0, 16, 16], [16, 16, 16]] },
    { corners = [[0, 16, 0], [0, 0, 0], [0, 0, 0], [0, 16, 16]] },
    { corners = [[16, 0, 0], [16, 16, 0], [16, 16, 16], [16, 16, 16]] },
    { corners = [[0, 16, 0], [16, 16, 0], [16, 0, 0], [0, 0, 0]] },
]
collision = [[0, 0, 0, 16, 16, 8], [0, 8, 8, 16, 16, 16]]
[[shape]]
name = "net"
boxes = [[7, 7, 0, 9, 9, 4]]
quads = [
    { corners = [[2.5, 2.5, 0], [13.5, 13.5, 0], [13.5, 13.5, 16], [2.5, 2.5, 16]], two_sided = true },
    { corners = [[0, 0, 16], [16, 0, 16], [16, 16, 16], [0, 16, 16]], two_sided = true, hidden_by = "+z" },
]
arms = { quads = [{ corners = [[8, 8, 0], [8, 16, 0], [8, 16, 12], [8, 8, 16]], uv = [[0, 16], [8, 16], [8, 4], [0, 0]] }] }
[[shape]]
name = "poster"
facing = true
quads = [{ corners = [[15, 15.5, 1], [1, 15.5, 1], [1, 15.5, 15], [15, 15.5, 15]], texture = "top", hidden_by = "-y" }]
collision = [[1, 15, 1, 15, 16, 15]]
)";

}  // namespace terrane::world
