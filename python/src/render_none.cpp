// World.render of a build without graphics.
#include "python/src/errors.h"
#include "python/src/world.h"

namespace py = pybind11;

namespace terrane::python {

void addRenderMethods(WorldClass& world) {
    addMethod(
        world, kRenderSignature,
        [](const PyWorld& /*self*/, const Arguments& /*given*/) {
            throw Failure({base::ErrorCode::Unsupported, "render: this build has no graphics"});
        },
        "An image of the world; this build has no graphics: it raises Error unsupported.");
}

}  // namespace terrane::python
