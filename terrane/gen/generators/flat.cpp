#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

void writeFlat(GeneratorBuilder& g) {
    g.pass3D("ground", [](Pass& p) {
        const Int z = p.z();
        const Block soil = select(z == 80, p.block("grass"), p.block("dirt"));
        const Block ground = select(z <= 76, p.block("stone"), soil);
        p.setBlock(select(z <= 80, ground, p.block("air")));
    });
}

}  // namespace terrane::gen
