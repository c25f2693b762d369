// Files compiled into the program (shaders, content, textures). tools/embed_files.py writes the tables.
#pragma once

#include <span>
#include <string_view>

namespace terrane::base {

struct EmbeddedFile {
    std::string_view path;  // as the CMake list names it, for example "terrane/render/sky.frag.glsl"
    std::string_view data;  // the whole file; lives as long as the program
};

}  // namespace terrane::base
