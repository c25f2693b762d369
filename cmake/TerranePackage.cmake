# Read by cpack before it makes packages. Without these tools they would come out without dependencies.
foreach(tool dpkg-shlibdeps file)
  find_program(TERRANE_TOOL ${tool} NO_CACHE)
  if(NOT TERRANE_TOOL)
    message(FATAL_ERROR "${tool} is missing: apt install dpkg-dev file")
  endif()
  unset(TERRANE_TOOL)
endforeach()
