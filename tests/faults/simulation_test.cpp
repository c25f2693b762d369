// Runs many seeds of the simulation: TERRANE_SEEDS seeds from TERRANE_FIRST_SEED (default 1), or only
// TERRANE_SEED.
#include "tests/faults/simulation.h"

#include <cstdio>
#include <cstdlib>

#include "terrane/base/log.h"
#include "tests/support/depth.h"

namespace terrane::store {
namespace {

unsigned numberFrom(const char* name, unsigned otherwise) {
    const char* value = std::getenv(name);
    return value ? static_cast<unsigned>(std::strtoul(value, nullptr, 10)) : otherwise;
}

class SimulationTest : public testing::Test {
  protected:
    SimulationTest() { base::setLogLevel(base::LogLevel::Silent); }
    ~SimulationTest() override { base::setLogLevel(base::LogLevel::Info); }
};

void add(SimulationCounts& sum, const SimulationCounts& one) {
    sum.steps += one.steps;
    sum.edits += one.edits;
    sum.loads += one.loads;
    sum.saves += one.saves;
    sum.unread += one.unread;
    sum.faults += one.faults;
    sum.failedOperations += one.failedOperations;
    sum.kills += one.kills;
    sum.powerLosses += one.powerLosses;
    sum.restarts += one.restarts;
    sum.seconds += one.seconds;
}

TEST_F(SimulationTest, NothingIsLost) {
    const unsigned only = numberFrom("TERRANE_SEED", 0);
    const unsigned first = only > 0 ? only : numberFrom("TERRANE_FIRST_SEED", 1);
    const unsigned count = only > 0 ? 1 : numberFrom("TERRANE_SEEDS", atDepth(8u, 1000u));
    SimulationCounts sum;
    for (unsigned seed = first; seed < first + count; ++seed) {
        Simulation simulation(seed);
        simulation.run();
        add(sum, simulation.counts());
        if (HasFailure()) {
            std::printf("TERRANE_SEED=%u plays this again\n", seed);
            break;
        }
    }
    if (count >= 24) {  // each kind of fault occurred
        for (const long happened :
             {sum.edits, sum.loads, sum.saves, sum.failedOperations, sum.kills, sum.powerLosses})
            EXPECT_GT(happened, 0);
    }
    std::printf(
        "%u seeds: %.0f s of play, %ld steps, %ld edits, %ld loads (%ld not readable), %ld saves, %ld faults "
        "(%ld operations), %ld kills, %ld power losses, %ld restarts\n",
        count, sum.seconds, sum.steps, sum.edits, sum.loads, sum.unread, sum.saves, sum.faults,
        sum.failedOperations, sum.kills, sum.powerLosses, sum.restarts);
}

TEST_F(SimulationTest, TheSameSeedDoesTheSame) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        std::uint64_t histories[2];
        for (std::uint64_t& history : histories) {
            Simulation simulation(seed);
            simulation.run();
            ASSERT_FALSE(HasFailure()) << "TERRANE_SEED=" << seed << " plays this again";
            history = simulation.history();
        }
        EXPECT_EQ(histories[0], histories[1]) << "seed " << seed;
    }
}

}  // namespace
}  // namespace terrane::store
