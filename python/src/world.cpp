#include "python/src/world.h"

#include <pybind11/stl.h>
#include <unistd.h>

#include <utility>

#include "python/src/errors.h"
#include "terrane/world/blocks/block_registry.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

// Opens a world without Python's lock.
template <class Open>
std::shared_ptr<PyWorld> makeWorld(const std::string& location, int threads, const Open& open) {
    auto sources = withoutLock([&]() -> base::Result<WorldSources> {
        const auto count = threadCountOf(threads);
        if (!count) return tl::unexpected(count.error());
        return open(*count);
    });
    return std::make_shared<PyWorld>(std::move(sources), location);
}

std::shared_ptr<PyWorld> makeGenerated(std::uint64_t seed, const std::string& generator, int threads,
                                       const std::vector<std::string>& content) {
    return makeWorld("", threads, [&](unsigned count) {
        return generatedWorld({seed, generator, content}, count);
    });
}

std::shared_ptr<PyWorld> openSaved(const SavedWorld& saved, int threads) {
    return makeWorld(saved.location, threads, [&](unsigned count) { return savedWorld(saved, count); });
}

std::vector<std::string> blockNames(const PyWorld& world) {
    std::vector<std::string> names;
    for (const world::BlockType& type : world.opened()->blocks().types()) names.push_back(type.name);
    return names;
}

int blockId(const PyWorld& world, const std::string& name) {
    const world::BlockType* type = world.opened()->blocks().find(name);
    if (type == nullptr) throw Failure({base::ErrorCode::NotFound, fmt::format("\"{}\" is no block", name)});
    return type->id;
}

std::string shown(const PyWorld& world) {
    const store::WorldIdentity& identity = world.identity();
    const std::string where = world.location().empty() ? "" : fmt::format(" {}", world.location());
    return fmt::format("<terrane.World{} seed={} generator={}{}>", where, identity.seed, identity.generator,
                       world.isClosed() ? " closed" : "");
}

void addOpening(py::module_& module, WorldClass& world) {
    const NewWorld otherwise;
    world.def(py::init(&makeGenerated), py::arg("seed") = otherwise.seed,
              py::arg("generator") = otherwise.generator, py::arg("threads") = 0, py::kw_only(),
              py::arg("content") = otherwise.content,
              R"(A generated world in memory. Edits last as long as the object.

seed: 0 to 2^64 - 1. generator: one of terrane.generators(content). threads: threads per call, 0: one per CPU
thread of the machine. content: names or paths of content packs.)");
    module.def(
        "open",
        [](const std::string& location, bool isReadOnly, bool isCreated, std::optional<std::uint64_t> seed,
           std::optional<std::string> generator, int threads, const std::vector<std::string>& content) {
            return openSaved({location, isReadOnly, isCreated, seed, std::move(generator), content}, threads);
        },
        py::arg("world"), py::kw_only(), py::arg("read_only") = false, py::arg("create") = false,
        py::arg("seed") = py::none(), py::arg("generator") = py::none(), py::arg("threads") = 0,
        py::arg("content") = std::vector<std::string>(),
        R"(Opens a saved world: the NAME of one, a FILE ("a.sqlite", "folder/a"), or a URL ("postgresql://host/name").

read_only: the save is not changed, and edits last as long as the object. create: creates a missing world. seed,
generator: of a new world; an existing world must have them. content: names or paths of content packs, besides those
that the world remembers. Raises Error with the code not_found, busy (another program writes it), incompatible, damaged,
and others.)");
}

void addProperties(WorldClass& world) {
    world
        .def_property_readonly(
            "seed", [](const PyWorld& self) { return self.identity().seed; }, "int: the world's seed.")
        .def_property_readonly(
            "generator", [](const PyWorld& self) { return self.identity().generator; },
            "str: the name of the world's generator.")
        .def_property_readonly("threads", &PyWorld::threads, "int: worker threads per call.")
        .def_property_readonly("location", &PyWorld::location,
                               "str: the name, file or URL of a saved world; empty for one in memory.")
        .def_property_readonly("closed", &PyWorld::isClosed, "bool: whether close() was called.")
        .def_property_readonly("block_names", &blockNames,
                               "list[str]: the names of all blocks; the index is the id. 0 is air.")
        .def("block_id", &blockId, py::arg("name"),
             "The id of a block, for example \"stone\". Raises Error not_found for other names.")
        .def("__repr__", &shown);
}

void addClosing(WorldClass& world) {
    world
        .def("flush", &PyWorld::flush,
             "Waits until all edits are on the disk, or in the database; raises Error where they cannot be.")
        .def("close", &PyWorld::close,
             "Saves all edits, and lets go of the world and its memory. Later calls of other methods raise "
             "Error; calls in progress go on, and the last of them lets go. Raises Error where edits cannot "
             "be "
             "saved: the world stays open then. Closing again does nothing.")
        .def(
            "__enter__", [](const std::shared_ptr<PyWorld>& self) { return self; }, "The world itself.")
        .def(
            "__exit__",
            [](PyWorld& self, const py::object&, const py::object&, const py::object&) { self.close(); },
            py::arg("type"), py::arg("value"), py::arg("traceback"), "Closes the world.");
}

}  // namespace

PyWorld::PyWorld(WorldSources sources, std::string location)
    : content_(std::move(sources.content)),
      location_(std::move(location)),
      threads_(sources.parts.threads),
      process_(getpid()) {
    opened_ = withoutLock([&] { return volume::OpenedWorld::create(std::move(sources.parts)); });
    identity_ = opened_->store().identity();
}

// Destroying the store writes pending data.
PyWorld::~PyWorld() {
    const py::gil_scoped_release unlocked;
    if (getpid() == process_)
        opened_.reset();
    else
        new std::shared_ptr<volume::OpenedWorld>(
            std::move(opened_));  // after a fork: its threads exist in the parent only, so leak it
}

std::shared_ptr<volume::OpenedWorld> PyWorld::opened() const {
    if (!opened_) throw Failure({base::ErrorCode::Failed, "the world is closed"});
    if (getpid() != process_)
        throw Failure({base::ErrorCode::Unsupported,
                       "the world was opened by another process: open it again in this one"});
    return opened_;
}

void PyWorld::flush() const {
    const auto world = opened();
    withoutLock([&] { return world->store().flush(); });
}

void PyWorld::close() {
    if (!opened_) return;
    flush();
    auto world = std::exchange(opened_, {});
    const py::gil_scoped_release unlocked;
    world.reset();
}

void addWorld(py::module_& module) {
    WorldClass world(module, "World",
                     R"(A world: generated terrain and its edits.

Arrays of blocks and light are by [z, y, x], arrays of columns by [y, x]; z is up, 0 to 255, and x and y are any
32-bit integers. Areas are in blocks and exclude their end. All methods may be called by several threads at
once; they release Python's lock while they work.)");
    addOpening(module, world);
    addProperties(world);
    addAreaMethods(world);
    addSurfaceMethods(world);
    addEditMethods(world);
    addRenderMethods(world);
    addClosing(world);
}

}  // namespace terrane::python
