#include "terrane/base/process.h"

#include <cerrno>

#include "terrane/base/platform.h"

namespace terrane::base {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCouldNotStart = 127;  // as in a shell

// Closed at the end of a scope.
struct Descriptor {
    int number = -1;
    ~Descriptor() { close(); }
    void close() {
        if (number >= 0) platform::closeFile(std::exchange(number, -1));
    }
};

Result<ChildResult> runOnce(const std::vector<std::string>& command, const ChildOptions& options) {
    const auto ends = platform::makePipe();
    if (!ends) return fail("{}: cannot be run: {}", command[0], systemReason(errno));
    Descriptor from{(*ends)[0]}, to{(*ends)[1]};
    std::error_code ignored;
    std::filesystem::remove(options.errorOutput, ignored);
    Descriptor errors{platform::createFile(options.errorOutput, platform::Readers::Everybody)};
    if (errors.number < 0) return ChildResult{.exitCode = kCouldNotStart};
    const auto start = Clock::now();
    platform::Child child;
    const int error = platform::startChild({.command = command,
                                            .folder = options.folder,
                                            .environment = options.environment,
                                            .output = to.number,
                                            .errors = errors.number},
                                           child);
    if (error == EAGAIN || error == ENOMEM)
        return fail("{}: cannot be run: {}", command[0], systemReason(error));
    if (error != 0) return ChildResult{.exitCode = kCouldNotStart};
    to.close();
    ChildResult end;
    end.timedOut = !platform::readUntil(from.number, start + options.timeout, end.output);
    if (end.timedOut) platform::killChild(child);
    from.close();
    const platform::ChildEnd ended = platform::waitForChild(child);
    end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    end.cpuSeconds = ended.cpuSeconds;
    end.exitCode = ended.exitCode;
    end.crashes = ended.crashed ? 1 : 0;
    return end;
}

}  // namespace

Result<ChildResult> runChild(const std::vector<std::string>& command, const ChildOptions& options) {
    if (command.empty()) return fail(ErrorCode::BadInput, "no program to run is named");
    int crashes = 0;
    for (int run = 1;; ++run) {
        auto end = TERRANE_TRY(runOnce(command, options));
        crashes += end.crashes;
        if (end.crashes > 0 && run < options.maxRuns) continue;
        end.crashes = crashes;
        return end;
    }
}

StopSignals::StopSignals() {
    platform::catchStops();
}

StopSignals::~StopSignals() {
    platform::releaseStops();
}

bool StopSignals::stopRequested() const {
    return platform::isStopRequested();
}

}  // namespace terrane::base
