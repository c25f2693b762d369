// The extension module terrane._terrane, imported by the package terrane.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/src/errors.h"
#include "python/src/open_world.h"
#include "python/src/world.h"
#include "terrane/base/log.h"

namespace py = pybind11;

PYBIND11_MODULE(_terrane, module) {
    using namespace terrane;
    module.doc() = "Terrane's worlds as NumPy arrays. Use the package terrane.";
    base::setLogLevel(base::LogLevel::Warning);
    py::options options;  // signatures are our own: see Signature
    options.disable_function_signatures();
    python::addErrors(module);
    python::addFunction(
        module, "generators(content=())",
        [](const python::Arguments& arguments) {
            const auto content = python::textsFrom(arguments["content"]);
            return python::withoutLock([&] { return python::generatorNames(content); });
        },
        "The names of all generators, for World(generator=...), those of content packs among them.");
    python::addWorld(module);
    module.attr("__version__") = TERRANE_VERSION;
    module.attr("has_graphics") = TERRANE_PYTHON_GRAPHICS != 0;
}
