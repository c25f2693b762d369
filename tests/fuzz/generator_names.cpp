// Replaces the generators, which are slow to compile: options need only their names.
#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

const GeneratorCatalogue& builtInGenerators() {
    static const GeneratorCatalogue catalogue;
    return catalogue;
}

std::vector<std::string> namesOf(const GeneratorCatalogue&) {
    return {"overworld", "flat"};
}

}  // namespace terrane::gen
