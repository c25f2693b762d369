#include "apps/terrane/graphics_info.h"
#include "terrane/gpu/context.h"

namespace terrane::app {

nlohmann::json graphicsInfo() {
    const auto context = gpu::HeadlessContext::create({});
    if (!context) return {{"error", context.error().message}};
    const gpu::DeviceInfo d = gpu::queryDevice();
    return {{"vendor", d.vendor},
            {"renderer", d.renderer},
            {"version", d.version},
            {"glsl", d.glsl},
            {"software", d.software},
            {"max_samples", d.maxSamples},
            {"max_storage_block_bytes", d.maxStorageBlockBytes},
            {"max_texture_size", d.maxTextureSize},
            {"max_texture_3d_size", d.maxTexture3dSize},
            {"max_anisotropy", d.maxAnisotropy}};
}

}  // namespace terrane::app
