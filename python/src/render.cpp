// World.render.
#include <pybind11/stl.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "python/src/arrays.h"
#include "python/src/draw_image.h"
#include "python/src/errors.h"
#include "python/src/world.h"
#include "terrane/render/frame/graphics_table.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

py::array_t<std::uint8_t> withoutAlpha(const base::Image& image) {
    auto pixels = zeros<std::uint8_t>({image.height, image.width, 3});
    std::uint8_t* to = pixels.mutable_data();
    for (std::size_t k = 0; k < image.rgba.size(); k += 4, to += 3) std::copy_n(&image.rgba[k], 3, to);
    return pixels;
}

float angleFrom(const Argument& argument, double low, double high) {
    return static_cast<float>(std::fmod(numberFrom(argument, low, high), 360));
}

glm::ivec2 sizeFrom(const Argument& argument) {
    constexpr std::array<std::size_t, 1> kCounts = {2};
    const auto n = integersFrom(argument, kCounts, "(width, height)");
    if (std::min(n[0], n[1]) < 1 || std::max(n[0], n[1]) > kMaxImageSide)
        refuse(argument, fmt::format("1 to {} pixels per side", kMaxImageSide));
    return {static_cast<int>(n[0]), static_cast<int>(n[1])};
}

std::string presetFrom(const Argument& argument) {
    std::string preset = textFrom(argument);
    if (const std::string wrong = render::presetNameError(preset); !wrong.empty())
        throw Failure({base::ErrorCode::BadInput, fmt::format("{}: {}", argument.name, wrong)});
    return preset;
}

ImageRequest requestFrom(const Arguments& arguments) {
    const auto at = positionFrom(arguments["position"]);
    const auto integer = [&](const char* name, int low, int high) {
        return static_cast<int>(integerFrom(arguments[name], low, high));
    };
    ImageRequest request;
    request.pose = {{at[0], at[1], at[2]},
                    angleFrom(arguments["yaw"], -kAnyNumber, kAnyNumber),
                    angleFrom(arguments["pitch"], -90, 90)};
    request.size = sizeFrom(arguments["size"]);
    request.fieldOfView = static_cast<float>(numberFrom(arguments["field_of_view"], 1, 170));
    request.timeDay = static_cast<float>(numberFrom(arguments["time"], 0, 1));
    request.viewDistance = integer("view_distance", 1, kMaxViewDistance);
    request.horizon = integer("horizon", 0, kMaxHorizon);
    request.preset = presetFrom(arguments["preset"]);
    return request;
}

// The worlds of this process that have drawn, for the end of the interpreter.
class DrawnWorlds {
  public:
    DrawnWorlds() : worlds_(py::module_::import("weakref").attr("WeakSet")()) {}

    // The drawer of a world, made at the first call.
    std::shared_ptr<ImageDrawer> drawerOf(PyWorld& self) {
        // Other threads run while Python adds it, so this comes first: one of them may close the world.
        worlds_.attr("add")(py::cast(&self, py::return_value_policy::reference));
        const auto world = self.opened();
        // A display of EGL is one for the process: a fork has its memory without its threads.
        if (process_ != 0 && process_ != getpid())
            throw Failure({base::ErrorCode::Unsupported,
                           "render: the parent of this process has drawn: start processes with the method "
                           "spawn"});
        process_ = getpid();
        if (!self.drawer())
            self.setDrawer(
                valueOr(ImageDrawer::create({world, self.content(), self.threads(), self.isOnlyWriter()})));
        return self.drawer();
    }

    // Drivers end their threads when the process does, and no image may be in progress then.
    void stopAll() const {
        if (process_ != getpid()) return;
        for (const py::handle world : py::list(worlds_)) {
            const auto drawer = world.cast<std::shared_ptr<PyWorld>>()->drawer();
            const py::gil_scoped_release unlocked;
            if (drawer) drawer->stop();
        }
    }

  private:
    py::object worlds_;
    int process_ = 0;  // that has drawn
};

}  // namespace

void addRenderMethods(WorldClass& world) {
    const auto drawn = std::make_shared<DrawnWorlds>();
    py::module_::import("atexit").attr("register")(py::cpp_function([drawn] { drawn->stopAll(); }));
    addMethod(
        world, kRenderSignature,
        [drawn](PyWorld& self, const Arguments& given) {
            const ImageRequest request = requestFrom(given);
            const auto drawer = drawn->drawerOf(self);
            return withoutAlpha(withoutLock([&] { return drawer->draw(request); }));
        },
        R"(An image of the world, drawn as by the program: uint8 [height, width, 3], red, green, blue (sRGB).

position: (x, y, z) of the eyes, blocks. yaw: degrees, 0 looks along x, 90 along y. pitch: degrees, 90 looks up.
size: (width, height), pixels, up to 8,192 each. time: of day, 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk.
view_distance: chunks in full detail, 1 to 64. horizon: chunks from the camera up to which land is drawn, coarse beyond
view_distance; 0 to 4,096, 0: none. preset: auto, low, medium, high, ultra, thesis. field_of_view: degrees, vertical,
1 to 170.
The first call of a world makes an OpenGL 4.5 context without a window, which the world keeps until it is closed, with
the chunks of the last image. Raises Error if the machine has none.)");
}

}  // namespace terrane::python
