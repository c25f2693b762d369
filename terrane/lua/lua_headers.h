// Lua's headers for Lua compiled as C++. lua.hpp declares functions with C names: Debian 12's library exports
// these, Debian 13's exports C++ names. The build finds out which (terrane/CMakeLists.txt).
#pragma once

#ifdef TERRANE_LUA_EXPORTS_CPP_NAMES
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#else
#include <lua.hpp>
#endif
