# Installing: the library with its headers, a CMake package and a pkg-config file (component "development"); the program with its
# manual page, completions, icon and menu entry (component "program", without graphics "server"); the package for Python
# (component "python", python/CMakeLists.txt). CPack makes a Debian package of each; tools/packages.sh makes all four.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(modules base shared world content_files content sound_files sound video store gen lua store_postgres light mesh rays path stream map volume format_files formats game pack io net net_postgres)
set(TERRANE_OPTIONAL_PKG "")
set(TERRANE_OPTIONAL_REQUIRES "")
if(TERRANE_GRAPHICS)
  list(APPEND modules shaders gpu gen_gpu light_gpu mesh_gpu render view)
  set(TERRANE_OPTIONAL_PKG "epoxy=epoxy")
  set(TERRANE_OPTIONAL_REQUIRES "epoxy")
endif()
if(TERRANE_HAS_POSTGRES)
  string(APPEND TERRANE_OPTIONAL_PKG " libpq=libpq")
  string(APPEND TERRANE_OPTIONAL_REQUIRES " libpq")
endif()
if(TERRANE_WEB)
  list(APPEND modules page_files web)
endif()
if(TERRANE_HAS_SOUND)
  string(APPEND TERRANE_OPTIONAL_PKG " openal=openal")
  string(APPEND TERRANE_OPTIONAL_REQUIRES " openal")
endif()
if(TERRANE_HAS_EXR)
  string(APPEND TERRANE_OPTIONAL_PKG " openexr=OpenEXR")
  string(APPEND TERRANE_OPTIONAL_REQUIRES " OpenEXR")
endif()

# Everything under one name.
add_library(terrane_all INTERFACE)
add_library(terrane::terrane ALIAS terrane_all)
set_target_properties(terrane_all PROPERTIES EXPORT_NAME terrane)
set(TERRANE_LINK_FLAGS "")
foreach(module IN LISTS modules)
  target_link_libraries(terrane_all INTERFACE terrane_${module})
  add_library(terrane::${module} ALIAS terrane_${module})
  set_target_properties(terrane_${module} PROPERTIES EXPORT_NAME ${module})
  get_target_property(type terrane_${module} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    string(PREPEND TERRANE_LINK_FLAGS "-lterrane_${module} ")  # users before what they use
  endif()
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/terrane)
list(TRANSFORM modules PREPEND terrane_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} terrane_flags terrane_all EXPORT terraneTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT terraneTargets NAMESPACE terrane:: DESTINATION ${package_folder} COMPONENT development)
# Headers of a module's own sources are named *_internal.h, those of its SIMD targets *-inl.h.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/terrane DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE PATTERN "*_internal.h" EXCLUDE)
configure_package_config_file(packaging/terraneConfig.cmake.in ${CMAKE_BINARY_DIR}/package/terraneConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/terraneConfigVersion.cmake COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH TERRANE_PC_TO_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(packaging/terrane.pc.in ${CMAKE_BINARY_DIR}/package/terrane.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/package/terraneConfig.cmake ${CMAKE_BINARY_DIR}/package/terraneConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/package/terrane.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES ${CMAKE_SOURCE_DIR}/assets/lua/terrane.lua DESTINATION ${CMAKE_INSTALL_DATADIR}/terrane/lua COMPONENT development)
install(DIRECTORY examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT development)

# The program; without graphics it is the program of a server, a package of its own (component "server").
set(program_component program)
if(NOT TERRANE_GRAPHICS)
  set(program_component server)
endif()
set(made ${CMAKE_BINARY_DIR}/package)
set(share ${CMAKE_INSTALL_DATADIR})
add_custom_command(OUTPUT ${made}/terrane.1.gz ${made}/terrane ${made}/_terrane ${made}/terrane.fish
  COMMAND terrane man > ${made}/terrane.1
  COMMAND gzip -9nf ${made}/terrane.1
  COMMAND terrane completion bash > ${made}/terrane
  COMMAND terrane completion zsh > ${made}/_terrane
  COMMAND terrane completion fish > ${made}/terrane.fish
  DEPENDS terrane COMMENT "Manual page, completions")
add_custom_target(terrane_extras ALL DEPENDS ${made}/terrane.1.gz)
install(TARGETS terrane RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${program_component})
install(FILES ${made}/terrane.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${program_component})
install(FILES ${made}/terrane DESTINATION ${share}/bash-completion/completions COMPONENT ${program_component})
install(FILES ${made}/_terrane DESTINATION ${share}/zsh/vendor-completions COMPONENT ${program_component})
install(FILES ${made}/terrane.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT ${program_component})
install(FILES packaging/terrane-server.service packaging/terrane-server.socket DESTINATION lib/systemd/system
  COMPONENT ${program_component})
if(TERRANE_GRAPHICS)
  add_custom_command(OUTPUT ${made}/terrane.png
    COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tools/paint_textures.py --icon ${made}/terrane.png
    DEPENDS ${CMAKE_SOURCE_DIR}/tools/paint_textures.py COMMENT "Icon")
  add_custom_target(terrane_icon ALL DEPENDS ${made}/terrane.png)
  install(FILES ${made}/terrane.png DESTINATION ${share}/icons/hicolor/128x128/apps COMPONENT program)
  install(FILES packaging/terrane.desktop DESTINATION ${share}/applications COMPONENT program)
  install(FILES packaging/org.terrane.terrane.metainfo.xml DESTINATION ${share}/metainfo COMPONENT program)
  install(FILES LICENSE DESTINATION ${share}/doc/terrane RENAME copyright COMPONENT program)
else()
  install(FILES LICENSE DESTINATION ${share}/doc/terrane-server RENAME copyright COMPONENT server)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libterrane-dev RENAME copyright COMPONENT development)

# cpack -G DEB
set(CPACK_GENERATOR DEB)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_SOURCE_DIR}/cmake/TerranePackage.cmake)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Large voxel worlds to walk, fly and build in")
set(CPACK_PACKAGE_CONTACT "Terrane <terrane@example.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${program_component})
if(TERRANE_GRAPHICS)
  list(APPEND CPACK_COMPONENTS_ALL development)
endif()
if(TERRANE_HAS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME terrane)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION games)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# libepoxy opens these while the program runs.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libgl1, libopengl0")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "fonts-dejavu-core, libgl1-mesa-dri, ffmpeg")
# Both have /usr/bin/terrane.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONFLICTS terrane-server)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_REPLACES terrane-server)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "A program to make worlds of blocks from a number, to walk, fly and build in them,
and to make pictures and videos of them.")
set(CPACK_DEBIAN_SERVER_PACKAGE_NAME terrane-server)
set(CPACK_DEBIAN_SERVER_PACKAGE_SECTION games)
set(CPACK_DEBIAN_SERVER_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SERVER_PACKAGE_CONFLICTS terrane)
set(CPACK_DEBIAN_SERVER_PACKAGE_REPLACES terrane)
set(CPACK_COMPONENT_SERVER_DESCRIPTION "The program terrane without graphics: servers, generation, maps in a browser.
It needs no OpenGL and no display.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libterrane-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libboost1.83-dev | libboost1.81-dev, libepoxy-dev, libexpected-dev, libfmt-dev, libglm-dev, libhwy-dev, libicu-dev, liblua5.4-dev, liblz4-dev, \
libopenal-dev, libopenexr-dev, libpng-dev, libpq-dev, libsodium-dev, libspdlog-dev, libsqlite3-dev, libssl-dev, libtomlplusplus-dev, libxxhash-dev, libzip-dev, libzstd-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The library that Terrane is made of: generation, saves, light, meshes, drawing.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-terrane)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/packaging/python3-terrane/prerm")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# An extension is for one version of Python.
math(EXPR next_python "${TERRANE_PYTHON_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${TERRANE_PYTHON_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
if(TERRANE_GRAPHICS)
  string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", libegl1, libgl1, libopengl0")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "libgl1-mesa-dri")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Terrane's worlds as NumPy arrays: blocks, heights, light, edits, images.")
include(CPack)
