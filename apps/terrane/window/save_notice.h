// Notices while a world cannot be saved. Immediate mode: drawn each frame.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/terrane/window/overlay.h"
#include "terrane/store/chunk_store.h"

namespace terrane::app {

// Shows the error, its duration and the number of waiting chunks at the top of the screen. Draws nothing
// while saving works.
void drawSaveNotice(const Screen& screen, const store::SaveStatus& status, const Texts& tr);

enum class QuitChoice : std::uint8_t { Stay, TryAgain, QuitUnsaved };

// Asks what to do after the last attempt to save failed. None until a button is clicked.
std::optional<QuitChoice> drawQuitDialog(const Screen& screen, const store::SaveStatus& status,
                                         const Texts& tr);

}  // namespace terrane::app
