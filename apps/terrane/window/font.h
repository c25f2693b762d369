// The font of the user interface, of the system where it has one with the letters of all languages.
#pragma once

namespace terrane::app {

// Of the system; null where it lacks the font.
const char* fontFile();
// In place of the fonts that Dear ImGui has, `pixels` high; its own font where `file` is null. The texture of
// the fonts is to be made next.
void addFont(float pixels, const char* file);
// After the texture is made: where the font lacks letters they are drawn without their accents.
void replaceMissingLetters();

}  // namespace terrane::app
