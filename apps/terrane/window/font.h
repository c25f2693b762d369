// The font of the user interface, of the system where it has one with the letters of all languages.
#pragma once

namespace terrane::app {

// In place of the fonts that Dear ImGui has, `pixels` high. The texture of the fonts is to be made next.
void addFont(float pixels);
// After the texture is made: where the font lacks letters they are drawn without their accents.
void replaceMissingLetters();

}  // namespace terrane::app
