#include "apps/terrane/window/imgui_layer.h"

#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

namespace terrane::app {
namespace {

void style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& s = ImGui::GetStyle();
    s.WindowRounding = 6;
    s.FrameRounding = 3;
    s.GrabRounding = 3;
    s.WindowBorderSize = 0;
    s.Colors[ImGuiCol_WindowBg] = ImVec4(0.06f, 0.07f, 0.09f, 0.78f);
    s.ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
}

}  // namespace

ImguiLayer::ImguiLayer(const gpu::Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // where its windows lie is ours to say
    style(window.contentScale());
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

ImguiLayer::~ImguiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ImguiLayer::beginFrame(bool isCursorCaptured) {
    ImGuiIO& io = ImGui::GetIO();
    if (isCursorCaptured) {
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange;
    } else {
        io.ConfigFlags &= ~(ImGuiConfigFlags_NoMouse | ImGuiConfigFlags_NoMouseCursorChange);
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
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

}  // namespace terrane::app
