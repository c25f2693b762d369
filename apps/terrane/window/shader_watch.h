// Reloads changed shaders during development.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "terrane/base/timed_value.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/renderer.h"
#include "terrane/view/block_preview.h"

namespace terrane::app {

class ShaderWatch {
  public:
    static constexpr double kPause = 1;  // seconds between checks of the files

    // The loader outlives this.
    explicit ShaderWatch(const gpu::ShaderLoader& shaders)
        : shaders_(shaders), read_(shaders.newestWrite()) {}

    // Reloads shaders that were written since the last call. Returns a message for the player; none if
    // nothing changed. Shaders with errors are not used. `seconds`: since the start.
    std::optional<std::string> reload(render::Renderer& renderer, view::BlockPreview& preview,
                                      double seconds);

  private:
    using WriteTime = std::optional<std::filesystem::file_time_type>;

    const gpu::ShaderLoader& shaders_;
    base::TimedValue<WriteTime> written_{kPause};
    WriteTime read_;  // newest time at the last reload
};

}  // namespace terrane::app
