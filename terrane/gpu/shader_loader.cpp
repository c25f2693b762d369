#include "terrane/gpu/shader_loader.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"

namespace terrane::gpu {

ShaderLoader::ShaderLoader(std::span<const base::EmbeddedFile> embedded, std::filesystem::path shaderRoot)
    : shaderRoot_(std::move(shaderRoot)) {
    addFiles(embedded);
}

void ShaderLoader::addFiles(std::span<const base::EmbeddedFile> embedded) {
    for (const base::EmbeddedFile& file : embedded)
        embedded_.insert_or_assign(std::string(file.path), file.data);
}

base::Result<ShaderSource> ShaderLoader::load(std::string_view name, ShaderStage stage,
                                              const ShaderDefines& defines) const {
    base::Result<ShaderSource> source =
        expandIncludes(name, [this](std::string_view path) { return find(path); });
    if (source) source->text.insert(0, shaderHeader(stage, defines));
    return source;
}

std::optional<std::string> ShaderLoader::find(std::string_view path) const {
    if (!shaderRoot_.empty())
        if (base::Result<std::string> text = base::readFile(shaderRoot_ / path)) return *std::move(text);
    if (const auto found = embedded_.find(path); found != embedded_.end()) return std::string(found->second);
    return std::nullopt;
}

std::optional<std::filesystem::file_time_type> ShaderLoader::newestWrite() const {
    namespace fs = std::filesystem;
    std::optional<fs::file_time_type> newest;
    if (shaderRoot_.empty()) return newest;
    std::error_code failed;  // a file may be replaced right now
    fs::recursive_directory_iterator file(shaderRoot_ / "terrane", failed);
    for (; !failed && file != fs::recursive_directory_iterator(); file.increment(failed)) {
        const fs::path extension = file->path().extension();
        if (extension != ".glsl" && extension != ".h") continue;
        std::error_code isGone;
        const fs::file_time_type written = file->last_write_time(isGone);
        if (!isGone) newest = std::max(newest.value_or(written), written);
    }
    return newest;
}

}  // namespace terrane::gpu
