// Stands in for the generators, of which options need the names alone: they take long to compile.
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
