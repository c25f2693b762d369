# terrane_module(name DEPS other modules… LIBS external targets…)
#
# Declares the library terrane_<name> from terrane/<name>/*.cpp. DEPS are the modules it may include; the table in
# docs/architecture.md says the same and tools/check_includes.py compares the sources with it.
function(terrane_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "DEPS;LIBS;PRIVATE_LIBS")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/terrane/${name}/*.cpp)
  list(TRANSFORM arg_DEPS PREPEND terrane_)
  if(sources)
    add_library(terrane_${name} STATIC ${sources})
    target_link_libraries(terrane_${name} PUBLIC terrane_flags ${arg_DEPS} ${arg_LIBS} PRIVATE ${arg_PRIVATE_LIBS})
  else()
    add_library(terrane_${name} INTERFACE)
    target_link_libraries(terrane_${name} INTERFACE terrane_flags ${arg_DEPS} ${arg_LIBS})
  endif()
endfunction()
