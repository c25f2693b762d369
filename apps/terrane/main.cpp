// All else is in the library of the program, which tests use too.
#include "apps/terrane/program.h"

int main(int argc, char** argv) {
    return terrane::app::runProgram(argc, argv);
}
