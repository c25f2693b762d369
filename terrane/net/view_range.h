// The chunks and tiles whose edits a client receives, as server and client both compute them. Any thread.
#pragma once

#include "terrane/net/client_message.h"

namespace terrane::net {

// A tile is sent if its distance is in this range, in widths of the tile (Chebyshev): nearer tiles are never
// drawn (docs/levels.md), and at the finest detail no tile is farther away.
constexpr int kNearestTile = 3, kFarthestTile = 33;

// What a server gives a client that asks for a view.
View servedView(const View& asked, int maxViewDistance);

// The coarsest level of the view's tiles; 0: it has none.
int topLevelOf(const View& view);

// `margin`: chunks or tiles beyond the view that count too.
bool isInView(const View& view, world::ChunkPos pos, int margin = 0);

}  // namespace terrane::net
