// The font of the user interface: the system's, if it has one with the letters of all languages.
#pragma once

namespace terrane::app {

// The system's font file; null if it has none of the known ones.
const char* fontFile();
// Replaces Dear ImGui's fonts by a font `pixels` high; its own font if `file` is null. Recreate the font
// texture afterwards.
void addFont(float pixels, const char* file);
// Call after the texture is made: letters that the font lacks are drawn without their accents.
void replaceMissingLetters();

}  // namespace terrane::app
