// The default keys as shown by `terrane play --help` and in the window.
#pragma once

namespace terrane::app {

constexpr const char* kKeyHelp =
    R"(  click                   look around with the mouse; Esc gives the cursor back
  W A S D, Space, Shift   walk, jump, run; E, Q: up, down where one flies or swims
  left, right button      break a block; build one, open a door or a chest (Shift: build against it)
  1 to 9, wheel           choose the block; middle button: the one that is looked at
  Tab                     all blocks, with search
  Ctrl+Z, Ctrl+Y          undo what one built, do it again
  B                       select a box: fill, replace, copy, paste, rotate, mirror, save
  M                       how one moves: on foot, fast or slowly through everything, not through walls
  N, H                    named places; go where the world begins
  T, Y                    on a server: talk; who plays
  O, P, I                 time of day back, forth; let it pass or stand still
  F1, F2                  these keys; settings and statistics
  F3, F4                  debug top view; a map of how far chunks are
  F5, F6                  save a bookmark, go to the next one
  F7, F8                  where one is; hide all over the image
  F11, F12, L             full screen; screenshot; light classic or smooth
  Esc                     close what is open, else the menu: settings, save and quit to title)";

}  // namespace terrane::app
