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

std::filesystem::file_time_type ShaderLoader::newestWrite(std::span<const std::string> files) const {
    auto newest = std::filesystem::file_time_type::min();
    if (shaderRoot_.empty()) return newest;
    for (const std::string& file : files) {
        std::error_code failed;  // an embedded file, or one being replaced right now
        const auto written = std::filesystem::last_write_time(shaderRoot_ / file, failed);
        if (!failed) newest = std::max(newest, written);
    }
    return newest;
}

}  // namespace terrane::gpu
