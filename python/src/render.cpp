// World.render.
#include "python/src/arrays.h"
#include "python/src/draw_image.h"
#include "python/src/errors.h"
#include "python/src/world.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

template <class T, std::size_t Count>
std::array<T, Count> numbersOf(const py::sequence& values, const char* what) {
    if (py::len(values) != Count)
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("{}: expected {} numbers, got {}", what, Count, py::len(values))});
    std::array<T, Count> numbers{};
    for (std::size_t k = 0; k < Count; ++k) numbers[k] = values[k].cast<T>();
    return numbers;
}

py::array_t<std::uint8_t> withoutAlpha(const base::Image& image) {
    auto pixels = zeros<std::uint8_t>({image.height, image.width, 3});
    std::uint8_t* to = pixels.mutable_data();
    for (std::size_t k = 0; k < image.rgba.size(); k += 4, to += 3) std::copy_n(&image.rgba[k], 3, to);
    return pixels;
}

py::array_t<std::uint8_t> renderImage(const PyWorld& self, const py::sequence& position, float yaw,
                                      float pitch, const py::sequence& size, const py::kwargs& options) {
    ImageRequest request;
    const auto at = numbersOf<double, 3>(position, "position");
    const auto pixels = numbersOf<int, 2>(size, "size");
    request.pose = {{at[0], at[1], at[2]}, yaw, pitch};
    request.size = {pixels[0], pixels[1]};
    for (const auto& [key, value] : options) {
        const auto name = key.cast<std::string>();
        if (name == "time")
            request.timeDay = value.cast<float>();
        else if (name == "view_distance")
            request.viewDistance = value.cast<int>();
        else if (name == "horizon")
            request.horizon = value.cast<int>();
        else if (name == "preset")
            request.preset = value.cast<std::string>();
        else if (name == "field_of_view")
            request.fieldOfView = value.cast<float>();
        else
            throw py::type_error(fmt::format("render() got an unexpected keyword argument '{}'", name));
    }
    const DrawnWorld world{self.opened(), self.content(), self.threads()};
    return withoutAlpha(withoutLock([&] { return drawImage(world, request); }));
}

}  // namespace

void addRenderMethods(WorldClass& world) {
    world.def(
        "render", &renderImage, py::arg("position"), py::arg("yaw") = 0.0f, py::arg("pitch") = 0.0f,
        py::arg("size") = py::make_tuple(640, 360),
        R"(An image of the world, drawn as by the program: uint8 [height, width, 3], red, green, blue (sRGB).

position: (x, y, z) of the eyes, blocks. yaw: degrees, 0 looks along x, 90 along y. pitch: degrees, 90 looks up.
size: (width, height), pixels, up to 8,192 each.
time: of day, 0 midnight, 0.2 dawn, 0.5 noon (default), 0.8 dusk. view_distance: chunks in full detail, 1 to 64,
16. horizon: chunks from the camera up to which land is drawn, coarse beyond view_distance; 0 to 4,096, by default 0: none. preset: low, medium, high
(default), ultra, thesis. field_of_view: degrees, vertical, 70.
Each call makes an OpenGL 4.5 context without a window. Raises Error if the machine has none.)");
}

}  // namespace terrane::python
