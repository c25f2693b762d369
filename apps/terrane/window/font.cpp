#include "apps/terrane/window/font.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <fstream>
#include <utility>

namespace terrane::app {
namespace {

// Paths of DejaVu Sans: Debian, Fedora, Arch.
constexpr std::array<const char*, 3> kFontFiles = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                                   "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                                   "/usr/share/fonts/TTF/DejaVuSans.ttf"};

// Latin letters with accents, dashes, quotation marks, the ellipsis and arrows. Dear ImGui reads the list
// whenever it makes the texture, so it must stay in memory.
constexpr std::array<ImWchar, 7> kLetters = {0x20, 0x17F, 0x2010, 0x2026, 0x2190, 0x2193, 0};

// Czech letters and punctuation that Dear ImGui's own font lacks, and their replacements.
constexpr std::array<std::pair<ImWchar, char>, 26> kPlainLetters = {
    {{0x10C, 'C'},  {0x10D, 'c'},  {0x10E, 'D'},  {0x10F, 'd'},   {0x11A, 'E'},   {0x11B, 'e'},
     {0x147, 'N'},  {0x148, 'n'},  {0x158, 'R'},  {0x159, 'r'},   {0x160, 'S'},   {0x161, 's'},
     {0x164, 'T'},  {0x165, 't'},  {0x16E, 'U'},  {0x16F, 'u'},   {0x17D, 'Z'},   {0x17E, 'z'},
     {0x2010, '-'}, {0x2013, '-'}, {0x2014, '-'}, {0x2018, '\''}, {0x2019, '\''}, {0x201C, '"'},
     {0x201D, '"'}, {0x201E, '"'}}};

}  // namespace

const char* fontFile() {
    for (const char* file : kFontFiles)
        if (std::ifstream(file).good()) return file;
    return nullptr;
}

void addFont(float pixels, const char* file) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.SizePixels = std::round(pixels);
    fonts.Clear();
    config.OversampleH = 2;
    if (file && fonts.AddFontFromFileTTF(file, config.SizePixels, &config, kLetters.data())) return;
    fonts.AddFontDefault(&config);
}

void replaceMissingLetters() {
    ImFont& font = *ImGui::GetIO().Fonts->Fonts[0];
    for (const auto& [letter, plain] : kPlainLetters)
        if (!font.FindGlyphNoFallback(letter)) font.AddRemapChar(letter, static_cast<ImWchar>(plain));
}

}  // namespace terrane::app
