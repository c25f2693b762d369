#include "terrane/base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace terrane::base {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCouldNotStart = 127;  // as in a shell

// Runs in the child process.
[[noreturn]] void become(std::vector<std::string> command, const ChildOptions& options, int output) {
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int errors = ::open(options.errorOutput.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (errors < 0 || nothing < 0 || ::chdir(options.folder.c_str()) != 0) ::_exit(kCouldNotStart);
    for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(output, STDOUT_FILENO);
    ::dup2(errors, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(kCouldNotStart);
}

// Reads until the other side closes the pipe; false if the time runs out first.
bool readAll(int from, Clock::time_point until, std::string& text) {
    std::array<char, 4096> part;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
        if (left.count() <= 0) return false;
        pollfd wanted{from, POLLIN, 0};
        const int ready = ::poll(&wanted, 1, static_cast<int>(left.count()));
        if (ready < 0 && errno != EINTR) return true;
        if (ready <= 0) continue;
        const ssize_t count = ::read(from, part.data(), part.size());
        if (count == 0 || (count < 0 && errno != EINTR)) return true;
        if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
    }
}

bool isCrash(int status) {
    constexpr std::array kSignals = {SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE};
    return WIFSIGNALED(status) && std::ranges::find(kSignals, WTERMSIG(status)) != kSignals.end();
}

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

Result<ChildResult> runOnce(const std::vector<std::string>& command, const ChildOptions& options) {
    std::array<int, 2> ends;
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail("{}: cannot be run: {}", command[0], systemReason(errno));
    const auto start = Clock::now();
    const pid_t child = ::fork();
    if (child == 0) become(command, options, ends[1]);
    const int forkError = errno;
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        return fail("{}: cannot be run: {}", command[0], systemReason(forkError));
    }
    ChildResult end;
    end.timedOut = !readAll(ends[0], start + options.timeout, end.output);
    if (end.timedOut) ::kill(child, SIGKILL);
    ::close(ends[0]);
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    end.cpuSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    end.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    end.crashes = isCrash(status) ? 1 : 0;
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

namespace {

// A signal handler may access nothing else.
volatile std::sig_atomic_t wasAsked = 0;

void ask(int) {
    wasAsked = 1;
}

}  // namespace

StopSignals::StopSignals() {
    wasAsked = 0;
    for (std::size_t k = 0; k < kSignals.size(); ++k) {
        before_[k] = std::signal(kSignals[k], ask);
        if (kSignals[k] == SIGHUP && before_[k] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) std::signal(kSignals[k], before_[k]);
}

bool StopSignals::stopRequested() const {
    return wasAsked != 0;
}

}  // namespace terrane::base
