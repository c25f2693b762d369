// An OpenGL 4.5 core context without a window or a display server, through EGL: for tests, `terrane render`
// and servers. The context is current on the thread that made it and is used on that thread only.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "terrane/base/result.h"
#include "terrane/gpu/debug.h"

namespace terrane::gpu {

// The properties and limits of the driver of a context, queried once after the context is created, on its
// thread.
struct DeviceInfo {
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string glsl;
    bool software = false;       // drawn by the CPU: the CPU back ends are faster then
    bool indirectCount = false;  // glMultiDraw*IndirectCount: draw counts written by the GPU
    bool indirectDraws = true;   // glMultiDraw*Indirect works: see render::checkedDevice()
    int maxSamples = 0;          // of color and depth textures that are drawn into
    int maxTextureSize = 0;
    int maxTexture3dSize = 0;
    int maxArrayLayers = 0;
    float maxAnisotropy = 1.0F;  // 1: not offered
    int subpixelBits = 4;        // a pixel is 2^bits steps of the grid that the rasterizer moves corners to
    std::int64_t maxStorageBlockBytes = 0;
    std::int64_t videoMemoryBytes = 0;  // free on the graphics card when queried; 0: unknown
};

[[nodiscard]] DeviceInfo queryDevice();

// Returns an error that names the first feature that the current context lacks.
[[nodiscard]] base::Result<void> checkRequirements();

struct ContextOptions {
    bool debug = false;       // a debug context whose messages are logged and whose errors are counted
    bool debugFatal = false;  // stop at the first error, inside the call at fault
};

class HeadlessContext {
  public:
    // Uses a graphics card if the system has one, else the software renderer.
    [[nodiscard]] static base::Result<HeadlessContext> create(const ContextOptions& options);

    HeadlessContext() = default;
    HeadlessContext(HeadlessContext&& other) noexcept;
    HeadlessContext& operator=(HeadlessContext&& other) noexcept;
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;
    ~HeadlessContext();

    void makeCurrent() const;
    // Gives the current context a default framebuffer, which it lacks without a window; it replaces an
    // earlier one.
    base::Result<void> setSurface(int width, int height);
    [[nodiscard]] bool valid() const { return context_ != nullptr; }

    // Returns the log of driver messages; null without the debug option.
    [[nodiscard]] DebugLog* debugLog() const { return debugLog_.get(); }
    // Returns the number of errors counted since the start or the last DebugLog::clear(); 0 without the debug
    // option.
    [[nodiscard]] int debugErrorCount() const { return debugLog_ ? debugLog_->errorCount() : 0; }

  private:
    static base::Result<HeadlessContext> createOn(void* display, const ContextOptions& options);
    void release();

    void* display_ = nullptr;  // EGLDisplay
    void* context_ = nullptr;  // EGLContext
    void* surface_ = nullptr;  // EGLSurface
    std::unique_ptr<DebugLog> debugLog_;
};

}  // namespace terrane::gpu
