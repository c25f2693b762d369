#include "terrane/gpu/device_info.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace terrane::gpu {
namespace {

// OpenGL 4.5, Implementation Dependent Values. (Mesa 22.3.6's zink says 4 on lavapipe, whose grid has 8.)
constexpr int kMinSubpixelBits = 4;

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
    info.subpixelBits = std::max(kMinSubpixelBits, glInt(GL_SUBPIXEL_BITS));
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

}  // namespace terrane::gpu
