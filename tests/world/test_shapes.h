// Shapes of boxes for tests: with facing and halves, with arms, with another form.
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
)";

}  // namespace terrane::world
