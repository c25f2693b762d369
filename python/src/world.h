// Python's class World: an opened world and its methods. Methods start with Python's lock, and release it
// while they work.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "python/src/arguments.h"
#include "python/src/open_world.h"
#include "terrane/volume/opened_world.h"
#include "terrane/volume/read_surfaces.h"

namespace terrane::python {

class ImageDrawer;  // draw_image.h

// The opened world is shared with running calls, so that close() does not wait for them.
class PyWorld {
  public:
    PyWorld(WorldSources sources, std::string location, bool isOnlyWriter);
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
    // Whether only this object changes the world: it is in memory, or a file that is open for writing.
    bool isOnlyWriter() const { return isOnlyWriter_; }

    // Draws images of the world; null before the first one. Ends with the world.
    const std::shared_ptr<ImageDrawer>& drawer() const { return drawer_; }
    void setDrawer(std::shared_ptr<ImageDrawer> drawer) { drawer_ = std::move(drawer); }

    void flush() const;
    void close();  // flushes; a second call does nothing

  private:
    pack::Content content_;
    std::shared_ptr<volume::OpenedWorld> opened_;
    std::string location_;
    store::WorldIdentity identity_;
    unsigned threads_;
    bool isOnlyWriter_;
    int process_;
    std::shared_ptr<ImageDrawer> drawer_;
};

using WorldClass = pybind11::class_<PyWorld, std::shared_ptr<PyWorld>>;

// The world that a method or a property was called with. TypeError for anything else.
std::shared_ptr<PyWorld> worldFrom(const pybind11::handle& self, std::string_view called);

// The id of a block's name. NotFound if no block has it.
world::BlockId blockId(const PyWorld& world, const std::string& name);

// Adds the method of a signature: function(world, arguments).
template <class Function>
void addMethod(WorldClass& world, const char* signature, Function function, std::string_view text) {
    const auto shared = std::make_shared<const Signature>(signature);
    const auto call = [shared, function](const pybind11::args& given, const pybind11::kwargs& named) {
        const Arguments arguments(*shared, given, named);
        return function(*worldFrom(arguments.self(), shared->name()), arguments);
    };
    world.def(shared->name().c_str(), call, shared->describedBy(text).c_str());
}

// Adds a property that cannot be set: function(world).
template <class Function>
void addProperty(WorldClass& world, const char* name, Function function, const char* text) {
    const auto call = [name, function](const pybind11::args& given) {
        return function(*worldFrom(given.empty() ? pybind11::object(pybind11::none()) : given[0], name));
    };
    world.def_property_readonly(name, pybind11::cpp_function(call), text);
}

// Adds the function of a signature to a module: function(arguments).
template <class Function>
void addFunction(pybind11::module_& module, const char* signature, Function function, std::string_view text) {
    const auto shared = std::make_shared<const Signature>(signature);
    const auto call = [shared, function](const pybind11::args& given, const pybind11::kwargs& named) {
        return function(Arguments(*shared, given, named));
    };
    module.def(shared->name().c_str(), call, shared->describedBy(text).c_str());
}

// Adds methods by subject, one file each.
void addAreaMethods(WorldClass& world);     // areas.cpp
void addSurfaceMethods(WorldClass& world);  // surfaces.cpp
void addEditMethods(WorldClass& world);     // edits.cpp
constexpr const char* kRenderSignature =
    "render(self, position, yaw=0, pitch=0, size=(640, 360), *, time=0.5, view_distance=16, horizon=0, "
    "preset=\"high\", field_of_view=70)";
void addRenderMethods(WorldClass& world);  // render.cpp, or render_none.cpp without graphics
void addWorld(pybind11::module_& module);  // world.cpp

}  // namespace terrane::python
