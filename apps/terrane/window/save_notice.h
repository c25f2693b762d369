// What a player is told while a world cannot be saved. Immediate mode: drawn each frame.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/terrane/window/overlay.h"
#include "terrane/store/chunk_store.h"

namespace terrane::app {

// What fails, for how long, how much waits and what helps: at the top of the screen. Nothing where saving
// works.
void drawSaveNotice(const Screen& screen, const store::SaveStatus& status, const Texts& tr);

enum class QuitChoice : std::uint8_t { Stay, TryAgain, QuitUnsaved };

// Asked where the last attempt to save failed. Nothing until a button is clicked.
std::optional<QuitChoice> drawQuitDialog(const Screen& screen, const store::SaveStatus& status,
                                         const Texts& tr);

}  // namespace terrane::app
