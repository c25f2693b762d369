// Detects changes to files of content packs, for `play --watch`. Used on one thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/timing.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/pack/pack.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/view/block_preview.h"

namespace terrane::app {

class ContentWatch {
  public:
    // Files that were saved after `readAt`, when the packs began to be read, count as changed.
    ContentWatch(const std::vector<pack::Pack>& packs, std::filesystem::file_time_type readAt);

    // Whether a file was added, removed or changed since the last call. Looks at most twice a second, and
    // reports a change once the files were stable for that long: editors write a file in several steps.
    bool hasChanged(std::chrono::steady_clock::time_point now);

  private:
    using Files = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Files look() const;

    std::vector<std::filesystem::path> packs_;
    Files reported_, seen_;
    std::chrono::steady_clock::time_point nextLook_{};
};

// Reloads changed shaders during development.
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
