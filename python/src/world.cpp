#include "python/src/world.h"

#include <pybind11/stl.h>
#include <unistd.h>

#include <utility>

#include "python/src/errors.h"
#include "terrane/game/spawn.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/world/blocks/block_registry.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

// Whether only this process changes the world: it is in memory, or a file that others cannot write.
bool isOnlyWriter(const SavedWorld& world) {
    const bool isUrl = store::worldLocation(world.location).kind == store::WorldLocation::Kind::Url;
    return world.location.empty() || (!world.isReadOnly && !isUrl);
}

// Opens a world without Python's lock. A world without a location is in memory.
template <class Open>
std::shared_ptr<PyWorld> makeWorld(const SavedWorld& world, unsigned threads, const Open& open) {
    auto sources = withoutLock([&] { return open(threadCountOf(threads)); });
    return std::make_shared<PyWorld>(std::move(sources), world.location, isOnlyWriter(world));
}

unsigned threadsFrom(const Argument& argument) {
    return static_cast<unsigned>(integerFrom(argument, 0, kMaxThreads));
}

std::optional<int> heightFrom(const Argument& argument) {
    if (argument.value.is_none()) return std::nullopt;
    return static_cast<int>(integerFrom(argument, world::kLowestBottom, world::kHighestTop));
}

std::shared_ptr<PyWorld> makeGenerated(const Arguments& arguments) {
    NewWorld made;
    made.seed = seedFrom(arguments["seed"]);
    made.generator = textFrom(arguments["generator"]);
    made.content = textsFrom(arguments["content"]);
    made.heights = {heightFrom(arguments["bottom"]), heightFrom(arguments["top"])};
    return makeWorld({}, threadsFrom(arguments["threads"]),
                     [&](unsigned count) { return generatedWorld(made, count); });
}

std::shared_ptr<PyWorld> openSaved(const Arguments& arguments) {
    const auto isGiven = [&](const char* name) { return !arguments[name].value.is_none(); };
    SavedWorld saved;
    saved.location = textFrom(arguments["world"]);
    saved.isReadOnly = boolFrom(arguments["read_only"]);
    saved.isCreated = boolFrom(arguments["create"]);
    if (isGiven("seed")) saved.seed = seedFrom(arguments["seed"]);
    if (isGiven("generator")) saved.generator = textFrom(arguments["generator"]);
    saved.content = textsFrom(arguments["content"]);
    saved.heights = {heightFrom(arguments["bottom"]), heightFrom(arguments["top"])};
    return makeWorld(saved, threadsFrom(arguments["threads"]),
                     [&](unsigned count) { return savedWorld(saved, count); });
}

std::vector<std::string> blockNames(const PyWorld& world) {
    std::vector<std::string> names;
    for (const world::BlockType& type : world.opened()->blocks().types()) names.push_back(type.name);
    return names;
}

// ((x, y, z), yaw, pitch): the first arguments of render().
py::tuple spawn(const PyWorld& self) {
    const auto world = self.opened();
    const world::Pose pose = withoutLock([&]() -> base::Result<world::Pose> {
        const gen::Generator* generator = TERRANE_TRY(world->generator(0));
        return game::findSpawn(*generator, world->blocks());
    });
    const glm::dvec3& at = pose.position;
    return py::make_tuple(py::make_tuple(at.x, at.y, at.z), pose.yaw, pose.pitch);
}

std::string shownWorld(const PyWorld& world, const Arguments& /*none*/) {
    const store::WorldIdentity& identity = world.identity();
    const std::string where = world.location().empty() ? "" : fmt::format(" {}", world.location());
    return fmt::format("<terrane.World{} seed={} generator={}{}>", where, identity.seed, identity.generator,
                       world.isClosed() ? " closed" : "");
}

void addOpening(py::module_& module, WorldClass& world) {
    const NewWorld otherwise;
    const std::string parameters =
        fmt::format("seed={}, generator=\"{}\", threads=0, *, content=(), bottom=None, top=None",
                    otherwise.seed, otherwise.generator);
    const auto init = std::make_shared<const Signature>(fmt::format("World({})", parameters));
    const Signature shown(fmt::format("__init__(self, {})", parameters));
    const std::string text =
        shown.describedBy(R"(A generated world in memory. Edits last as long as the object.

seed: an integer from -2^63 to 2^64 - 1, or a text, as --seed takes it. generator: one of
terrane.generators(content). threads: threads per call, 0: one per CPU thread of the machine. content: names or paths of
content packs. bottom, top: the lowest layer and the one above the highest, multiples of 16 from -2048 to 2048; None: the
generator's.)");
    world.def(py::init([init](const py::args& given, const py::kwargs& named) {
                  return makeGenerated(Arguments(*init, given, named));
              }),
              text.c_str());
    addFunction(
        module,
        "open(world, *, read_only=False, create=False, seed=None, generator=None, threads=0, content=(), "
        "bottom=None, top=None)",
        &openSaved,
        R"(Opens a saved world: the NAME of one, a FILE ("a.sqlite", "folder/a"), or a URL ("postgresql://host/name").

read_only: the save is not changed, and edits last as long as the object. create: creates a missing world. seed,
generator, bottom, top: of a new world; an existing world must have them. content: names or paths of content packs, besides those
that the world remembers. Raises Error with the code not_found, busy (another program writes it), incompatible, damaged,
and others.)");
}

void addProperties(WorldClass& world) {
    addProperty(
        world, "seed", [](const PyWorld& self) { return self.identity().seed; },
        "int: the world's seed, 0 to 2^64 - 1.");
    addProperty(
        world, "generator", [](const PyWorld& self) { return self.identity().generator; },
        "str: the name of the world's generator.");
    addProperty(
        world, "bottom", [](const PyWorld& self) { return self.identity().heights.bottom; },
        "int: the lowest layer of the world.");
    addProperty(
        world, "top", [](const PyWorld& self) { return self.identity().heights.top; },
        "int: the layer above the highest one of the world.");
    addProperty(
        world, "threads", [](const PyWorld& self) { return self.threads(); },
        "int: worker threads per call.");
    addProperty(
        world, "location", [](const PyWorld& self) { return self.location(); },
        "str: the name, file or URL of a saved world; empty for one in memory.");
    addProperty(
        world, "closed", [](const PyWorld& self) { return self.isClosed(); },
        "bool: whether close() was called.");
    addProperty(world, "block_names", &blockNames,
                "list[str]: the names of all blocks; the index is the id. 0 is air.");
    addProperty(world, "spawn", &spawn,
                "((x, y, z), yaw, pitch): the eyes of a new player, as the first arguments of render(). The "
                "same world gives the same place.");
    addMethod(
        world, "block_id(self, name)",
        [](const PyWorld& self, const Arguments& given) { return blockId(self, textFrom(given["name"])); },
        "The id of a block, for example \"stone\". Raises Error not_found for other names.");
    addMethod(world, "__repr__(self)", &shownWorld, "The world as text.");
}

void addClosing(WorldClass& world) {
    const auto close = [](PyWorld& self, const Arguments& /*none*/) { self.close(); };
    addMethod(
        world, "flush(self)", [](const PyWorld& self, const Arguments& /*none*/) { self.flush(); },
        "Waits until all edits are on the disk, or in the database; raises Error where they cannot be.");
    addMethod(world, "close(self)", close,
              "Saves all edits, and lets go of the world and its memory. Later calls of other methods raise "
              "Error; calls in progress go on, and the last of them lets go. Raises Error where edits cannot "
              "be saved: the world stays open then. Closing again does nothing.");
    addMethod(
        world, "__enter__(self)",
        [](const PyWorld& /*self*/, const Arguments& given) { return given.self(); }, "The world itself.");
    addMethod(world, "__exit__(self, type, value, traceback)", close, "Closes the world.");
}

}  // namespace

std::shared_ptr<PyWorld> worldFrom(const py::handle& self, std::string_view called) {
    if (!py::isinstance<PyWorld>(self))
        throw py::type_error(
            fmt::format("{} needs a World, got a value of type {}", called, Py_TYPE(self.ptr())->tp_name));
    try {
        return self.cast<std::shared_ptr<PyWorld>>();
    } catch (const py::cast_error&) {  // made by World.__new__() alone
        throw py::type_error(fmt::format("{} needs a World that __init__() has opened", called));
    }
}

world::BlockId blockId(const PyWorld& world, const std::string& name) {
    const auto opened = world.opened();
    const world::BlockType* type = opened->blocks().find(name);
    if (type == nullptr) throw Failure({base::ErrorCode::NotFound, fmt::format("\"{}\" is no block", name)});
    return type->id;
}

PyWorld::PyWorld(WorldSources sources, std::string location, bool isOnlyWriter)
    : content_(std::move(sources.content)),
      location_(std::move(location)),
      threads_(sources.parts.threads),
      isOnlyWriter_(isOnlyWriter),
      process_(getpid()) {
    opened_ = withoutLock([&] { return volume::OpenedWorld::create(std::move(sources.parts)); });
    identity_ = opened_->store().identity();
}

// Destroying the store writes pending data.
PyWorld::~PyWorld() {
    const py::gil_scoped_release unlocked;
    if (getpid() == process_) {
        drawer_.reset();
        opened_.reset();
    } else {  // after a fork: its threads exist in the parent only, so leak it
        new std::pair(std::move(drawer_), std::move(opened_));
    }
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
    auto drawer = std::exchange(drawer_, {});
    auto world = std::exchange(opened_, {});
    const py::gil_scoped_release unlocked;
    drawer.reset();
    world.reset();
}

void addWorld(py::module_& module) {
    WorldClass world(module, "World",
                     R"(A world: generated terrain and its edits.

Arrays of blocks and light are by [z, y, x], arrays of columns by [y, x]; z is up, from bottom to top - 1, and x and
y are any 32-bit integers. Areas are in blocks and exclude their end. All methods may be called by several threads at
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
