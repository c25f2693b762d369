#include "apps/terrane/window/imgui_layer.h"

#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>

#include "apps/terrane/window/font.h"
#include "apps/terrane/window/pad_navigation.h"

#include "apps/terrane/window/ui_style.h"

namespace terrane::app {
namespace {

struct UiKey {
    Key key;
    ImGuiKey imguiKey;
};

constexpr UiKey kUiKeys[] = {
    {Key::Enter, ImGuiKey_Enter},      {Key::Escape, ImGuiKey_Escape}, {Key::Space, ImGuiKey_Space},
    {Key::Tab, ImGuiKey_Tab},          {Key::Delete, ImGuiKey_Delete}, {Key::Left, ImGuiKey_LeftArrow},
    {Key::Right, ImGuiKey_RightArrow}, {Key::Up, ImGuiKey_UpArrow},    {Key::Down, ImGuiKey_DownArrow}};

constexpr float kFontPixels = 13;  // height of Dear ImGui's own font, the unit of all sizes

// The index in Dear ImGui's array of keys; -1 for a key that it does not use.
int indexOf(Key key) {
    const auto* found = std::ranges::find(kUiKeys, key, &UiKey::key);
    return found == std::end(kUiKeys) ? -1 : ImGui::GetKeyIndex(found->imguiKey);
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

ImguiLayer::ImguiLayer(const Window& window) : window_(&window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // windows are placed by the program
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

ImguiLayer::~ImguiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ImguiLayer::beginFrame(bool isCursorCaptured, bool isInMenu) {
    ImGuiIO& io = ImGui::GetIO();
    constexpr int kNavigation = ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavEnableGamepad;
    io.ConfigFlags = isInMenu ? io.ConfigFlags | kNavigation : io.ConfigFlags & ~kNavigation;
    if (isCursorCaptured) {
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange;
    } else {
        io.ConfigFlags &= ~(ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange);
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    holdShortPresses();
    dropRepeatedText();
    if (isInMenu) {
        setPadNavigation(window_->gamepad(), ImGui::GetIO().NavInputs);
        activateByEnter();
    }
    followScale();
    ImGui::NewFrame();
}

// Dear ImGui 1.86 samples keys when a frame begins. A key that was pressed and released since the last frame
// counts as down for one frame.
void ImguiLayer::holdShortPresses() {
    bool(&isDown)[IM_ARRAYSIZE(ImGuiIO::KeysDown)] = ImGui::GetIO().KeysDown;
    for (const Key key : shortPresses_) isDown[indexOf(key)] = window_->keyDown(key);
    shortPresses_.clear();
    for (const InputEvent& event : window_->events()) {
        if (event.type != InputEvent::Type::KeyPress || indexOf(event.key) < 0 || window_->keyDown(event.key))
            continue;
        shortPresses_.push_back(event.key);
        isDown[indexOf(event.key)] = true;
    }
}

// Drops repeated characters of the held key that opened a text field: input starts with the next key press.
void ImguiLayer::dropRepeatedText() {
    ImGuiIO& io = ImGui::GetIO();
    if (window_->anyKeyPressed())
        acceptsText_ = true;
    else if (!io.WantTextInput)
        acceptsText_ = false;
    if (!acceptsText_) io.InputQueueCharacters.resize(0);
}

#if IMGUI_VERSION_NUM < 18700
constexpr ImGuiKey kKeypadEnter = ImGuiKey_KeyPadEnter;
#else
constexpr ImGuiKey kKeypadEnter = ImGuiKey_KeypadEnter;
#endif

// Enter activates, as Space does. An Enter that ends text input activates nothing, however long it is held.
void ImguiLayer::activateByEnter() {
    ImGuiIO& io = ImGui::GetIO();
    const bool isDown = ImGui::IsKeyDown(ImGui::GetKeyIndex(ImGuiKey_Enter)) ||
                        ImGui::IsKeyDown(ImGui::GetKeyIndex(kKeypadEnter));
    if (!isDown) enter_ = Enter::Up;
    if (isDown && enter_ == Enter::Up) enter_ = io.WantTextInput ? Enter::Types : Enter::Chooses;
    if (enter_ == Enter::Chooses) io.NavInputs[ImGuiNavInput_Activate] = 1;
}

// Applies a new scale: at the start, and when the window moves to a screen with another scale. On systems
// whose units are larger than pixels Dear ImGui uses these units: it applies only the rest of the scale.
void ImguiLayer::followScale() {
    const Scale scale{window_->contentScale(), window_->pixelsPerUnit(), textSize_};
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
