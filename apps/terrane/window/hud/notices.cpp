#include "apps/terrane/window/hud/notices.h"

#include <algorithm>

namespace terrane::app {

void drawNotices(const Screen& screen, const Notices& notices, const KeyBindings& keys, const Texts& tr) {
    const auto shareOf = [](double seconds) { return static_cast<float>(std::min(seconds, 1.0)); };
    if (notices.helpSeconds > 0) drawKeyHelp(screen, shareOf(notices.helpSeconds), keyHelpLines(keys, tr));
    if (notices.messageSeconds > 0) drawMessage(screen, notices.message, shareOf(notices.messageSeconds));
}

}  // namespace terrane::app
