// Python's class World: an opened world and its methods. Methods start with Python's lock, and release it
// while they work.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

#include "python/src/open_world.h"
#include "terrane/volume/opened_world.h"
#include "terrane/volume/read_surfaces.h"

namespace terrane::python {

// The opened world is shared with running calls, so that close() does not wait for them.
class PyWorld {
  public:
    PyWorld(WorldSources sources, std::string location);
    ~PyWorld();
    PyWorld(const PyWorld&) = delete;
    PyWorld& operator=(const PyWorld&) = delete;

    // Throws Failure if the world is closed, or was opened by another process (a fork lacks its threads).
    std::shared_ptr<volume::OpenedWorld> opened() const;
    const pack::Content& content() const { return content_; }
    bool isClosed() const { return opened_ == nullptr; }
    const std::string& location() const { return location_; }  // empty: in memory
    const store::WorldIdentity& identity() const { return identity_; }
    unsigned threads() const { return threads_; }

    void flush() const;
    void close();  // flushes; a second call does nothing

  private:
    pack::Content content_;
    std::shared_ptr<volume::OpenedWorld> opened_;
    std::string location_;
    store::WorldIdentity identity_;
    unsigned threads_;
    int process_;
};

using WorldClass = pybind11::class_<PyWorld, std::shared_ptr<PyWorld>>;

// Adds methods by subject, one file each.
void addAreaMethods(WorldClass& world);     // areas.cpp
void addSurfaceMethods(WorldClass& world);  // surfaces.cpp
void addEditMethods(WorldClass& world);     // edits.cpp
void addRenderMethods(WorldClass& world);   // render.cpp, or render_none.cpp without graphics
void addWorld(pybind11::module_& module);   // world.cpp

}  // namespace terrane::python
