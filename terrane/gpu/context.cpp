#include "terrane/gpu/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::gpu {

namespace {

// OpenGL 4.5, Implementation Dependent Values. (Mesa 22.3.6's zink says 4 on lavapipe, whose grid has 8.)
constexpr int kMinSubpixelBits = 4;
constexpr int kMaxSubpixelBits = 16;  // nothing needs more, and floats tell these apart

std::string glText(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

int glInt(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

bool isSoftware(std::string_view renderer) {
    for (std::string_view name : {"llvmpipe", "softpipe", "SwiftShader"})
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

float anisotropyLimit() {
    if (epoxy_gl_version() < 46 && !epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") &&
        !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        return 1.0F;
    GLfloat value = 1.0F;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &value);
    return value;
}

// Both extensions count in KiB. Drivers of software renderers report the memory of the computer.
std::int64_t videoMemory(bool isSoftware) {
    constexpr std::int64_t kKiB = 1024;
    if (isSoftware) return 0;
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        return kKiB * glInt(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX);
    if (!epoxy_has_gl_extension("GL_ATI_meminfo")) return 0;
    std::array<GLint, 4> free{};  // in all, the largest block; then the same of auxiliary memory
    glGetIntegerv(GL_VBO_FREE_MEMORY_ATI, free.data());
    return kKiB * free[0];
}

}  // namespace

DeviceInfo queryDevice() {
    DeviceInfo info;
    info.vendor = glText(GL_VENDOR);
    info.renderer = glText(GL_RENDERER);
    info.version = glText(GL_VERSION);
    info.glsl = glText(GL_SHADING_LANGUAGE_VERSION);
    info.software = isSoftware(info.renderer);
    info.indirectCount = epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_indirect_parameters");
    info.maxSamples = std::min(
        {glInt(GL_MAX_SAMPLES), glInt(GL_MAX_COLOR_TEXTURE_SAMPLES), glInt(GL_MAX_DEPTH_TEXTURE_SAMPLES)});
    info.maxTextureSize = glInt(GL_MAX_TEXTURE_SIZE);
    info.maxTexture3dSize = glInt(GL_MAX_3D_TEXTURE_SIZE);
    info.maxArrayLayers = glInt(GL_MAX_ARRAY_TEXTURE_LAYERS);
    info.maxAnisotropy = anisotropyLimit();
    info.subpixelBits = std::clamp(glInt(GL_SUBPIXEL_BITS), kMinSubpixelBits, kMaxSubpixelBits);
    GLint64 blockBytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &blockBytes);
    info.maxStorageBlockBytes = blockBytes;
    info.videoMemoryBytes = videoMemory(info.software);
    return info;
}

base::Result<void> checkRequirements() {
    constexpr int kMinVersion = 45;
    const int version = epoxy_gl_version();
    if (version < kMinVersion)
        return base::fail("OpenGL 4.5 is needed; {} offers {}.{}", glText(GL_RENDERER), version / 10,
                          version % 10);
    if (version < 46 && !epoxy_has_gl_extension("GL_ARB_shader_draw_parameters"))
        return base::fail("GL_ARB_shader_draw_parameters is needed; {} (OpenGL {}) lacks it",
                          glText(GL_RENDERER), glText(GL_VERSION));
    return {};
}

namespace {

bool clientExtension(std::string_view name) {
    const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return all != nullptr && std::string_view(all).find(name) != std::string_view::npos;
}

EGLDisplay surfacelessDisplay() {
    if (!clientExtension("EGL_EXT_platform_base") || !clientExtension("EGL_MESA_platform_surfaceless"))
        return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
}

bool isSoftwareDevice(EGLDeviceEXT device) {
    const char* all = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return all != nullptr && std::string_view(all).find("EGL_MESA_device_software") != std::string_view::npos;
}

std::vector<EGLDeviceEXT> listDevices(bool withSoftware) {
    if (!clientExtension("EGL_EXT_platform_device")) return {};
    EGLint count = 0;
    if (eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (eglQueryDevicesEXT(count, devices.data(), &count) == EGL_FALSE) return {};
    devices.resize(static_cast<std::size_t>(count));
    if (!withSoftware) std::erase_if(devices, isSoftwareDevice);
    return devices;
}

}  // namespace

base::Result<HeadlessContext> HeadlessContext::createOn(void* display, const ContextOptions& options) {
    // Displays are never terminated: EGL gives every caller the same one, so that would end other contexts
    // too.
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return base::fail("EGL finds no display to draw without a window");
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return base::fail("EGL offers no desktop OpenGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 options.debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    HeadlessContext result;
    result.display_ = display;
    result.context_ = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (result.context_ == EGL_NO_CONTEXT)
        return base::fail("OpenGL 4.5 core is needed; EGL refuses it (error {:#x})", eglGetError());
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, result.context_) == EGL_FALSE)
        return base::fail("EGL cannot draw without a surface (error {:#x})", eglGetError());
    if (base::Result<void> fit = checkRequirements(); !fit) return tl::unexpected(fit.error());
    if (options.debug) result.debugLog_ = enableDebugOutput(options.debugFatal);
    return result;
}

base::Result<HeadlessContext> HeadlessContext::create(const ContextOptions& options) {
    if (!epoxy_has_egl()) return base::fail("drawing without a window needs libEGL, which is not installed");
    base::Result<HeadlessContext> surfaceless = createOn(surfacelessDisplay(), options);
    if (surfaceless && !queryDevice().software) return surfaceless;

    // The surfaceless platform belongs to Mesa. Cards of other drivers are found as devices only.
    for (EGLDeviceEXT device : listDevices(!surfaceless)) {
        void* display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        base::Result<HeadlessContext> onDevice = createOn(display, options);
        if (onDevice) return onDevice;
    }
    if (surfaceless) surfaceless->makeCurrent();
    return surfaceless;
}

HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)),
      context_(std::exchange(other.context_, nullptr)),
      surface_(std::exchange(other.surface_, nullptr)),
      debugLog_(std::move(other.debugLog_)) {}

HeadlessContext& HeadlessContext::operator=(HeadlessContext&& other) noexcept {
    if (this == &other) return *this;
    release();
    display_ = std::exchange(other.display_, nullptr);
    context_ = std::exchange(other.context_, nullptr);
    surface_ = std::exchange(other.surface_, nullptr);
    debugLog_ = std::move(other.debugLog_);
    return *this;
}

HeadlessContext::~HeadlessContext() {
    release();
}

void HeadlessContext::makeCurrent() const {
    assert(context_ != nullptr && "an empty context cannot be current");
    [[maybe_unused]] const EGLBoolean done = eglMakeCurrent(display_, surface_, surface_, context_);
    assert(done == EGL_TRUE && "a context that was current before can be current again on its thread");
}

base::Result<void> HeadlessContext::setSurface(int width, int height) {
    const EGLint kinds[] = {EGL_SURFACE_TYPE,
                            EGL_PBUFFER_BIT,
                            EGL_RENDERABLE_TYPE,
                            EGL_OPENGL_BIT,
                            EGL_RED_SIZE,
                            8,
                            EGL_GREEN_SIZE,
                            8,
                            EGL_BLUE_SIZE,
                            8,
                            EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, kinds, &config, 1, &count) == EGL_FALSE || count == 0)
        return base::fail("EGL offers no framebuffer without a window (error {:#x})", eglGetError());
    const EGLint attributes[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
    EGLSurface made = eglCreatePbufferSurface(display_, config, attributes);
    if (made == EGL_NO_SURFACE || eglMakeCurrent(display_, made, made, context_) == EGL_FALSE)
        return base::fail("EGL makes no framebuffer of {} x {} (error {:#x})", width, height, eglGetError());
    if (surface_ != nullptr) eglDestroySurface(display_, surface_);
    surface_ = made;
    // A context that began without a framebuffer draws nowhere.
    GLboolean isDouble = GL_FALSE;
    glGetBooleanv(GL_DOUBLEBUFFER, &isDouble);
    const GLenum buffer = isDouble == GL_TRUE ? GL_BACK : GL_FRONT;
    glNamedFramebufferDrawBuffer(0, buffer);
    glNamedFramebufferReadBuffer(0, buffer);
    return {};
}

void HeadlessContext::release() {
    if (context_ == nullptr) return;
    if (eglGetCurrentContext() == context_)
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    if (surface_ != nullptr) eglDestroySurface(display_, surface_);
    context_ = surface_ = nullptr;
}

}  // namespace terrane::gpu
