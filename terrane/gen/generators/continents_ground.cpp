// What is under the ground of continents.
#include "terrane/gen/generators/continents.h"

namespace terrane::gen::continents {

void groundPass(Pass& p, const Fields& f) {
    constexpr int kSoilDepth = 3;
    const Int z = p.z(), surface = p.read(f.surface);
    const Block open = select(z <= p.read(f.water), p.block("water"), p.block("air"));
    const Block earth = select(z == surface, p.read(f.top), select(z >= surface - kSoilDepth, p.read(f.soil), p.read(f.rock)));
    p.setBlock(select(z <= surface, earth, open));
}

}  // namespace terrane::gen::continents
