// The generators of the tutorial in docs/worldgen.md, step by step.
#pragma once

#include "terrane/gen/language/builder.h"

namespace terrane::examples {

void writeStep1(gen::GeneratorBuilder& g);
void writeStep2(gen::GeneratorBuilder& g);
void writeStep3(gen::GeneratorBuilder& g);
void writeStep4(gen::GeneratorBuilder& g);
// The section on rivers.
void writeRivers(gen::GeneratorBuilder& g);

}  // namespace terrane::examples
