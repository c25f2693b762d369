# terrane_embed(target NAME function OUT_DIR… FILES path=file …)
#
# Compiles files into a static library `target` that defines
#   std::span<const terrane::base::EmbeddedFile> terrane::embedded::<function>();
# Each FILES entry is "virtual/path=real/file". The header is terrane/base/files.h.
function(terrane_embed target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAME" "FILES;DEPENDS")
  set(source ${CMAKE_BINARY_DIR}/embedded/${target}.cpp)
  set(real_files)
  foreach(entry IN LISTS arg_FILES)
    string(REGEX REPLACE "^[^=]*=" "" file "${entry}")
    list(APPEND real_files "${file}")
  endforeach()
  add_custom_command(
    OUTPUT ${source}
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/embed_files.py ${source} ${arg_NAME} ${arg_FILES}
    DEPENDS ${CMAKE_SOURCE_DIR}/tools/embed_files.py ${real_files} ${arg_DEPENDS}
    COMMENT "Embedding files of ${target}" VERBATIM)
  add_library(${target} STATIC ${source})
  target_link_libraries(${target} PUBLIC terrane_flags terrane_base)
endfunction()
