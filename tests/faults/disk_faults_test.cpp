// Every disk operation fails once, or permanently; the program is killed or the power fails at every
// operation that changes a file. TERRANE_DEPTH=all tests all of them, otherwise every 29th.
#include <cstdio>
#include <cstdlib>

#include "terrane/base/log.h"
#include "tests/faults/play.h"
#include "tests/support/depth.h"

namespace terrane::store {
namespace {

struct StartCase {
    const char* name;
    Start (*make)();
};

class DiskFaults : public testing::TestWithParam<StartCase> {
  protected:
    DiskFaults() { base::setLogLevel(base::LogLevel::Silent); }
    ~DiskFaults() override { base::setLogLevel(base::LogLevel::Info); }

    static long step() { return atDepth(29, 1); }

    // One run with the faults of `arrange`. Returns false if nothing failed any more.
    bool play(FaultyDisk& disk, bool lasts, const std::function<void()>& arrange) {
        const base::TempFolder folder;
        Play play(folder, start_);
        disk.restart();  // forgets the files of the last run
        disk.seedRandomness(1);
        arrange();
        play.run(lasts);
        const bool hasFailed = disk.failures() > 0 || disk.hasStopped();
        EXPECT_TRUE(play.reportsAll || (hasFailed && !isHarmless_)) << "nothing failed";
        disk.restart();
        play.verify();
        return hasFailed;
    }

    // Fails all operations of these kinds, one after the other.
    void failAll(unsigned kinds, DiskError error, long count) {
        isHarmless_ = error == DiskError::Short;
        FaultyDisk disk;
        long runs = 0;
        for (long n = 0;; n += step()) {
            SCOPED_TRACE(fmt::format("operation {} of kinds {}, error {}, {} times", n, kinds,
                                     static_cast<int>(error), count));
            if (!play(disk, count > 1, [&] { disk.fail(kinds, n, count, error); })) break;
            ++runs;
            if (HasFailure()) return;
        }
        EXPECT_GT(runs, 0);
        std::printf("%s: %ld operations failed\n", GetParam().name, runs);
    }

    void stopAll(DiskStop stop, unsigned seeds) {
        FaultyDisk disk;
        long runs = 0;
        for (long n = 0;; n += step()) {
            bool hasStopped = false;
            for (unsigned seed = 0; seed < seeds; ++seed) {
                SCOPED_TRACE(
                    fmt::format("stop {} after {} changes, seed {}", static_cast<int>(stop), n, seed));
                hasStopped = play(disk, true, [&] { disk.stopAfter(stop, n, seed); });
                runs += hasStopped ? 1 : 0;
                if (HasFailure()) return;
            }
            if (!hasStopped) break;
        }
        EXPECT_GT(runs, 0);
        std::printf("%s: stopped %ld times\n", GetParam().name, runs);
    }

    bool isHarmless_ = false;
    Start start_ = GetParam().make();
};

TEST_P(DiskFaults, EachFailsOnce) {
    failAll(kDiskAny, DiskError::Io, 1);
}
TEST_P(DiskFaults, EachFailsFromThenOn) {
    failAll(kDiskAny, DiskError::Io, LONG_MAX);
}
TEST_P(DiskFaults, TheDiskIsFullOnce) {
    failAll(kDiskWrite | kDiskOpen | kDiskMap, DiskError::Full, 1);
}
TEST_P(DiskFaults, TheDiskIsFullFromThenOn) {
    failAll(kDiskWrite | kDiskOpen | kDiskMap, DiskError::Full, LONG_MAX);
}
TEST_P(DiskFaults, EachIsDoneByHalvesOnce) {
    failAll(kDiskRead | kDiskWrite, DiskError::Short, 1);
}
TEST_P(DiskFaults, EachIsDoneByHalvesFromThenOn) {
    failAll(kDiskRead | kDiskWrite, DiskError::Short, LONG_MAX);
}
TEST_P(DiskFaults, TheProgramIsKilled) {
    stopAll(DiskStop::Kill, 2);
}
TEST_P(DiskFaults, ThePowerGoes) {
    stopAll(DiskStop::PowerLoss, atDepth(2, 40));
}

INSTANTIATE_TEST_SUITE_P(Starts, DiskFaults,
                         testing::Values(StartCase{"NewSave", emptyFolder},
                                         StartCase{"Format1", saveOfFormat1},
                                         StartCase{"DamagedRows", saveWithDamagedRows},
                                         StartCase{"AfterKill", saveAfterKill}),
                         [](const auto& start) { return start.param.name; });

}  // namespace
}  // namespace terrane::store
