# terrane_tests(target prefix LABELS label): one CTest test for each suite of a GoogleTest program, registered after each link.
#
# A suite is one process, so that its cases share what is costly to make (an OpenGL context, a renderer, a server). Names are
# PREFIX.Suite. tests/costs.txt has the seconds of long suites: CTest starts these first.
set(terrane_list_suites ${CMAKE_CURRENT_LIST_DIR}/ListSuites.cmake)

function(terrane_suites target prefix label)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${list}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D PREFIX=${prefix} -D LABEL=${label} -D LIST=${list}
      -D COSTS=${CMAKE_SOURCE_DIR}/tests/costs.txt -P ${terrane_list_suites}
    VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  file(WRITE ${include}
    "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${prefix}_NOT_BUILT ${prefix}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
