#include "terrane/light/light_area.h"

#include <gtest/gtest.h>

#include "tests/light/area_solver_cases.h"

namespace terrane::light {
namespace {

TEST(AreaSolver, SolvesWhatEveryBackEndSolves) {
    const auto solver = makeCpuSolver(contentTable());
    EXPECT_EQ(solver->backend(), "cpu");
    expectSolverCases(*solver);
}

}  // namespace
}  // namespace terrane::light
