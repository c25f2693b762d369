# Whether the package for Python is built (python/), and for which Python: the system's, whose pybind11 and NumPy are
# Debian packages. Sets TERRANE_HAS_PYTHON and
# TERRANE_PYTHON_MINOR (11 for Python 3.11). Sanitizers want a Python of their own: no package is built with them.
set(TERRANE_HAS_PYTHON OFF)
set(TERRANE_PYTHON_MINOR 0)
if(TERRANE_PYTHON AND NOT TERRANE_SANITIZE AND NOT TERRANE_FUZZ)
  find_program(TERRANE_PYTHON_PROGRAM python3 PATHS /usr/bin NO_DEFAULT_PATH DOC "Python that the package is built for")
  if(NOT TERRANE_PYTHON_PROGRAM)
    find_program(TERRANE_PYTHON_PROGRAM python3)
  endif()
  set(Python_EXECUTABLE ${TERRANE_PYTHON_PROGRAM})
  find_package(Python QUIET COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    find_package(pybind11 2.10 QUIET)
  endif()
  if(pybind11_FOUND)
    set(TERRANE_HAS_PYTHON ON)
    set(TERRANE_PYTHON_MINOR ${Python_VERSION_MINOR})
  endif()
endif()

# The extension is a shared library made of the static ones, so these are position independent. Functions of one file
# may be inlined as before: nobody replaces them when the program is loaded.
if(TERRANE_HAS_PYTHON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  target_compile_options(terrane_flags INTERFACE $<BUILD_INTERFACE:-fno-semantic-interposition>)
endif()
