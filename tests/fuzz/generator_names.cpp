// Stands in for the generators, of which options need the names alone: they take long to compile.
#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

std::vector<std::string> generatorNames() {
    return {"overworld", "flat"};
}

}  // namespace terrane::gen
