#include "apps/terrane/window/shader_watch.h"

#include "terrane/base/log.h"

namespace terrane::app {

std::optional<std::string> ShaderWatch::reload(render::Renderer& renderer, view::BlockPreview& preview,
                                               double seconds) {
    const WriteTime written = written_.at(seconds, [&] { return shaders_.newestWrite(); });
    if (written == read_) return std::nullopt;
    read_ = written;
    auto done = renderer.reloadShaders();
    if (done) done = preview.reloadShaders();
    if (done) return "shaders reloaded";
    base::logWarning("{}", done.error().message);
    return done.error().message;
}

}  // namespace terrane::app
