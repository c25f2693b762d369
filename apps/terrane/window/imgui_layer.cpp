#include "apps/terrane/window/imgui_layer.h"

#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "apps/terrane/window/input.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/base/platform.h"

namespace terrane::app {

namespace {

// Paths of DejaVu Sans: beside the program, as in the archive for Windows; Debian, Fedora, Arch.
constexpr std::array<const char*, 4> kFontFiles = {
    "DejaVuSans.ttf", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf"};

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

std::string fontFile() {
    const std::filesystem::path folder = base::platform::programFile().parent_path();
    for (const char* file : kFontFiles)
        if (const auto path = folder / file; std::ifstream(path).good()) return path.string();
    return {};
}

void addFont(float pixels, const std::string& file) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.SizePixels = std::round(pixels);
    fonts.Clear();
    config.OversampleH = 2;
    if (!file.empty() && fonts.AddFontFromFileTTF(file.c_str(), config.SizePixels, &config, kLetters.data()))
        return;
    fonts.AddFontDefault(&config);
}

void replaceMissingLetters() {
    ImFont& font = *ImGui::GetIO().Fonts->Fonts[0];
    for (const auto& [letter, plain] : kPlainLetters)
        if (!font.FindGlyphNoFallback(letter)) font.AddRemapChar(letter, static_cast<ImWchar>(plain));
}

namespace {

struct UiKey {
    Key key;
    ImGuiKey imguiKey;
    bool isLetter = false;  // of the player's keyboard, as for Ctrl+A
};

// The keys that Dear ImGui uses.
constexpr UiKey kUiKeys[] = {
    {Key::Enter, ImGuiKey_Enter},       {Key::Escape, ImGuiKey_Escape},  {Key::Space, ImGuiKey_Space},
    {Key::Tab, ImGuiKey_Tab},           {Key::Left, ImGuiKey_LeftArrow}, {Key::Right, ImGuiKey_RightArrow},
    {Key::Up, ImGuiKey_UpArrow},        {Key::Down, ImGuiKey_DownArrow}, {Key::PageUp, ImGuiKey_PageUp},
    {Key::PageDown, ImGuiKey_PageDown}, {Key::Home, ImGuiKey_Home},      {Key::End, ImGuiKey_End},
    {Key::Insert, ImGuiKey_Insert},     {Key::Delete, ImGuiKey_Delete},  {Key::Backspace, ImGuiKey_Backspace},
    {Key::A, ImGuiKey_A, true},         {Key::C, ImGuiKey_C, true},      {Key::V, ImGuiKey_V, true},
    {Key::X, ImGuiKey_X, true},         {Key::Y, ImGuiKey_Y, true},      {Key::Z, ImGuiKey_Z, true}};

// Dear ImGui 1.87 replaced its arrays of keys by events.
#if IMGUI_VERSION_NUM < 18700
void numberKeys(ImGuiIO& io) {
    for (const UiKey& key : kUiKeys) io.KeyMap[key.imguiKey] = static_cast<int>(key.key);
}

void setKey(ImGuiIO& io, const UiKey& key, bool isDown) {
    io.KeysDown[io.KeyMap[key.imguiKey]] = isDown;
}

void setModifiers(ImGuiIO& io, Modifiers with) {
    io.KeyShift = with.shift;
    io.KeyCtrl = with.control;
}
#else
void numberKeys(ImGuiIO&) {}

void setKey(ImGuiIO& io, const UiKey& key, bool isDown) {
    io.AddKeyEvent(key.imguiKey, isDown);
}

void setModifiers(ImGuiIO& io, Modifiers with) {
    io.AddKeyEvent(ImGuiKey_ModShift, with.shift);
    io.AddKeyEvent(ImGuiKey_ModCtrl, with.control);
}
#endif

constexpr float kFontPixels = 13;  // height of Dear ImGui's own font, the unit of all sizes

// A key that was pressed and released since the last frame counts as down for one frame.
bool isDown(const Window& window, Key key) {
    return window.keyDown(key) || std::ranges::any_of(window.events(), [&](const InputEvent& event) {
               return event.type == InputEvent::Type::KeyPress && event.key == key;
           });
}

// Rasterizes the font at its size on the screen, so that it is sharp.
void setFont(float pixels) {
    addFont(pixels, fontFile());
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    replaceMissingLetters();
}

}  // namespace

float uiScale() {
    return ImGui::GetFontSize() / kFontPixels;
}

ImguiLayer::ImguiLayer(Window& window) : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // windows are placed by the program
    io.UserData = window.widgets();
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* layer) {
        auto& self = *static_cast<ImguiLayer*>(layer);
        self.clipboard_ = self.window_.clipboard();
        return self.clipboard_.c_str();
    };
    io.SetClipboardTextFn = [](void* layer, const char* text) {
        static_cast<ImguiLayer*>(layer)->window_.setClipboard(text);
    };
    numberKeys(io);
    if (WidgetRecord* widgets = window.widgets()) widgets->clear();
    seconds_ = window.timeSeconds();
    ImGui_ImplOpenGL3_Init("#version 150");  // of OpenGL 3.2: error_window.h needs no more
}

ImguiLayer::~ImguiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void ImguiLayer::beginFrame(bool isCursorCaptured, bool isInMenu) {
    ImGuiIO& io = ImGui::GetIO();
    constexpr int kNavigation = ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavEnableGamepad;
    io.ConfigFlags = isInMenu ? io.ConfigFlags | kNavigation : io.ConfigFlags & ~kNavigation;
    io.ConfigFlags = isCursorCaptured ? io.ConfigFlags | ImGuiConfigFlags_NoMouse
                                      : io.ConfigFlags & ~ImGuiConfigFlags_NoMouse;
    ImGui_ImplOpenGL3_NewFrame();
    feedScreen();
    feedKeys();
    feedMouse();
    feedText();
    const bool usesPad = isInMenu && !isPadIgnored_;
    const std::optional<Gamepad> pad = usesPad ? window_.gamepad() : std::nullopt;
    io.BackendFlags = pad ? io.BackendFlags | ImGuiBackendFlags_HasGamepad
                          : io.BackendFlags & ~ImGuiBackendFlags_HasGamepad;
    setPadNavigation(pad, io.NavInputs);
    if (isInMenu) activateByEnter();
    followScale();
    if (WidgetRecord* widgets = window_.widgets()) widgets->clear();
    ImGui::NewFrame();
}

void ImguiLayer::feedScreen() {
    constexpr double kLeastSeconds = 1e-5;  // Dear ImGui needs some
    ImGuiIO& io = ImGui::GetIO();
    const double now = window_.timeSeconds();
    io.DeltaTime = static_cast<float>(std::max(now - std::exchange(seconds_, now), kLeastSeconds));
    const glm::ivec2 size = window_.size();
    const float scale = window_.pixelsPerUnit();
    io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
    io.DisplayFramebufferScale = {scale, scale};
}

void ImguiLayer::feedKeys() {
    ImGuiIO& io = ImGui::GetIO();
    const Modifiers with{window_.keyDown(Key::Shift), window_.keyDown(Key::Control)};
    setModifiers(io, with);
    for (const UiKey& key : kUiKeys) {
        if (key.isLetter)
            setKey(io, key, with.control && isDown(window_, window_.keyTyping(key.key)));
        else
            setKey(io, key, isDown(window_, key.key));
    }
}

// As for keys, a brief click counts as one frame.
void ImguiLayer::feedMouse() {
    ImGuiIO& io = ImGui::GetIO();
    constexpr float kOutside = -std::numeric_limits<float>::max();
    const std::optional<glm::dvec2> at = window_.cursor();
    io.MousePos =
        at ? ImVec2(static_cast<float>(at->x), static_cast<float>(at->y)) : ImVec2(kOutside, kOutside);
    for (const MouseButton button : {MouseButton::Left, MouseButton::Right, MouseButton::Middle})
        io.MouseDown[static_cast<int>(button)] = window_.buttonDown(button);
    for (const InputEvent& event : window_.events()) {
        if (event.type == InputEvent::Type::ButtonPress) io.MouseDown[static_cast<int>(event.button)] = true;
        if (event.type != InputEvent::Type::Wheel) continue;
        io.MouseWheelH += static_cast<float>(event.x);
        io.MouseWheel += static_cast<float>(event.y);
    }
}

// Drops repeated characters of the held key that opened a text field: input starts with the next key press.
void ImguiLayer::feedText() {
    ImGuiIO& io = ImGui::GetIO();
    if (window_.anyKeyPressed())
        acceptsText_ = true;
    else if (!io.WantTextInput)
        acceptsText_ = false;
    if (!acceptsText_) return;
    for (const unsigned character : window_.characters()) io.AddInputCharacter(character);
}

// Enter activates, as Space does. An Enter that ends text input activates nothing, however long it is held.
void ImguiLayer::activateByEnter() {
    ImGuiIO& io = ImGui::GetIO();
    const bool isEnter = isDown(window_, Key::Enter);
    if (!isEnter) enter_ = Enter::Up;
    if (isEnter && enter_ == Enter::Up) enter_ = io.WantTextInput ? Enter::Types : Enter::Chooses;
    if (enter_ == Enter::Chooses) io.NavInputs[ImGuiNavInput_Activate] = 1;
}

// Applies a new scale: at the start, and when the window moves to a screen with another scale. On systems
// whose units are larger than pixels Dear ImGui uses these units: it applies only the rest of the scale.
void ImguiLayer::followScale() {
    const Scale scale{window_.contentScale(), window_.pixelsPerUnit(), textSize_};
    if (scale == scale_) return;
    scale_ = scale;
    setUiStyle(textSize_ * scale.content / scale.pixelsPerUnit);
    setFont(kFontPixels * textSize_ * scale.content);
    ImGui::GetIO().FontGlobalScale = 1 / scale.pixelsPerUnit;
}

glm::vec2 ImguiLayer::size() const {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    return {size.x, size.y};
}

void ImguiLayer::endFrame() {
    ImGui::Render();
    window_.setTextCursor(ImGui::GetMouseCursor() == ImGuiMouseCursor_TextInput);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool ImguiLayer::takesMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool ImguiLayer::takesKeys() const {
    return ImGui::GetIO().WantTextInput;
}

bool ImguiLayer::hasPopup() const {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
}

void ImguiLayer::endTyping() {
    ImGui::SetWindowFocus(nullptr);
}

}  // namespace terrane::app
