# One set of compile flags for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# One build for those who play and those who test: with assertions, which packages leave out.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
if(NOT TERRANE_ASSERTIONS)
  string(APPEND CMAKE_CXX_FLAGS_RELEASE " -DNDEBUG")
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(terrane_flags INTERFACE)
# Contraction of a*b+c into one rounding differs between machines: the generator must not depend on it.
set(terrane_warnings -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast)
if(TERRANE_WERROR)
  list(APPEND terrane_warnings -Werror)
endif()
target_compile_options(terrane_flags INTERFACE -ffp-contract=off $<BUILD_INTERFACE:-fno-math-errno;${terrane_warnings}>)
target_compile_features(terrane_flags INTERFACE cxx_std_20)
target_include_directories(terrane_flags INTERFACE
  $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
# Highway's vectors without instructions convert NaN to an integer, as those with instructions do.
if(TERRANE_SANITIZE)
  target_compile_options(terrane_flags INTERFACE
    -fsanitize=${TERRANE_SANITIZE} -fno-sanitize-recover=all -fno-sanitize=float-cast-overflow
    -fno-omit-frame-pointer -g1)
  target_link_options(terrane_flags INTERFACE -fsanitize=${TERRANE_SANITIZE})
endif()
