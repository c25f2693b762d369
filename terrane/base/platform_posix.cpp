#include "terrane/base/platform.h"

#include <execinfo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>

extern char** environ;

namespace terrane::base::platform {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int errorOf(bool isDone) {
    return isDone ? 0 : errno;
}

FileStatus statusFrom(const struct stat& status) {
    return {.isRegular = S_ISREG(status.st_mode),
            .isFolder = S_ISDIR(status.st_mode),
            .sizeBytes = static_cast<std::uint64_t>(status.st_size),
            .nameCount = status.st_nlink,
            .identity = {status.st_dev, status.st_ino}};
}

int flushPath(const fs::path& path, int flags) {
    const int descriptor = ::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return errno;
    const int error = flush(descriptor);
    ::close(descriptor);
    return error;
}

std::string linkOf(int descriptor) {
    return fmt::format("/proc/self/fd/{}", descriptor);
}

}  // namespace

std::optional<FileStatus> statusOf(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return std::nullopt;
    return statusFrom(status);
}

std::optional<FileStatus> statusOf(const fs::path& path, Links links) {
    struct stat status {};
    const int failed =
        links == Links::Follow ? ::stat(path.c_str(), &status) : ::lstat(path.c_str(), &status);
    if (failed != 0) return std::nullopt;
    return statusFrom(status);
}

int openToRead(const fs::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

int createFile(const fs::path& path, Readers readers) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                  readers == Readers::Owner ? 0600 : 0666);
}

// Fails if the file could not be named later.
int createUnnamed(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 || ::access(linkOf(descriptor).c_str(), F_OK) == 0) return descriptor;
    ::close(descriptor);
    return -1;
}

int giveName(int descriptor, const fs::path& path) {
    return errorOf(
        ::linkat(AT_FDCWD, linkOf(descriptor).c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0);
}

std::ptrdiff_t readSome(int descriptor, std::span<char> bytes) {
    for (;;) {
        const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
        if (count >= 0 || errno != EINTR) return count;
    }
}

std::ptrdiff_t readAt(int descriptor, std::span<char> bytes, std::uint64_t offsetBytes) {
    return ::pread(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offsetBytes));
}

int writeAt(int descriptor, std::string_view bytes, std::uint64_t offsetBytes) {
    while (!bytes.empty()) {
        const ssize_t count =
            ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offsetBytes));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count < 0 ? errno : EIO;
        bytes.remove_prefix(static_cast<std::size_t>(count));
        offsetBytes += static_cast<std::uint64_t>(count);
    }
    return 0;
}

int truncate(int descriptor) {
    return errorOf(::ftruncate(descriptor, 0) == 0);
}

int reserve(int descriptor, std::uint64_t sizeBytes) {
    if (sizeBytes > static_cast<std::uint64_t>(INT64_MAX)) return EFBIG;
    return errorOf(sizeBytes == 0 || ::fallocate(descriptor, 0, 0, static_cast<off_t>(sizeBytes)) == 0);
}

bool isNoRoom(int error) {
    return error == ENOSPC || error == EDQUOT || error == EFBIG;
}

int flush(int descriptor) {
    return errorOf(::fsync(descriptor) == 0);
}

int flushFile(const fs::path& path) {
    return flushPath(path, 0);
}

int flushFolder(const fs::path& path) {
    return flushPath(path, O_DIRECTORY);
}

int closeFile(int descriptor) {
    return errorOf(::close(descriptor) == 0);
}

void takeMode(int descriptor, const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) (void)::fchmod(descriptor, status.st_mode & 0777);
}

int replaceFile(const fs::path& from, const fs::path& to) {
    return errorOf(std::rename(from.c_str(), to.c_str()) == 0);
}

bool canBeFileName(std::string_view) {
    return true;
}

bool isWritableFolder(const fs::path& folder) {
    return ::access(folder.c_str(), W_OK) == 0;
}

int makeFolder(const fs::path& start, fs::path& made) {
    std::string path = start.string() + "XXXXXX";
    if (!::mkdtemp(path.data())) return errno;
    made = path;
    return 0;
}

int openLockFile(const fs::path& path, bool isShared) {
    constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | kFlags, 0644);
    const bool isForbidden = descriptor < 0 && (errno == EACCES || errno == EROFS || errno == EPERM);
    if (!isForbidden || !isShared) return descriptor;
    return ::open(path.c_str(), O_RDONLY | kFlags);
}

int tryLock(int descriptor, bool isShared) {
    return errorOf(::flock(descriptor, (isShared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0);
}

namespace {

// The environment with the variables added, as execvpe() takes it: the texts must outlive the pointers.
std::vector<std::string> environmentWith(std::span<const std::pair<std::string, std::string>> added) {
    std::vector<std::string> texts;
    const auto isReplaced = [&](std::string_view text) {
        return std::ranges::any_of(
            added, [&](const auto& variable) { return text.starts_with(variable.first + "="); });
    };
    for (char** at = environ; *at; ++at)
        if (!isReplaced(*at)) texts.emplace_back(*at);
    for (const auto& [name, value] : added) texts.push_back(name + "=" + value);
    return texts;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

struct ChildTexts {
    char* const* arguments;
    char* const* environment;
};

// Runs in the child process, which may have been forked from a program with threads: it allocates no memory.
// `report`: a pipe that takes the errno if the program cannot be run.
[[noreturn]] void become(const ChildStart& start, const ChildTexts& texts, int report) {
    if (start.isIndependent)
        ::setpgid(0, 0);
    else
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    bool isReady = start.folder.empty() || ::chdir(start.folder.c_str()) == 0;
    const int streams[] = {start.input, start.output, start.errors};
    for (int stream = 0; stream < 3; ++stream) {
        const int from = streams[stream] >= 0 ? streams[stream] : ::open("/dev/null", O_RDWR | O_CLOEXEC);
        isReady = isReady && from >= 0 && ::dup2(from, stream) == stream;
    }
    if (isReady) ::execvpe(texts.arguments[0], texts.arguments, texts.environment);
    const int error = errno;
    (void)!::write(report, &error, sizeof error);
    ::_exit(127);  // as in a shell
}

bool isCrash(int status) {
    constexpr std::array kSignals = {SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE};
    return WIFSIGNALED(status) && std::ranges::find(kSignals, WTERMSIG(status)) != kSignals.end();
}

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

int startChild(const ChildStart& start, Child& child) {
    std::vector<std::string> command = start.command, variables = environmentWith(start.environment);
    const std::vector<char*> arguments = pointersTo(command), environment = pointersTo(variables);
    const auto report = makePipe();
    if (!report) return errno;
    const pid_t made = ::fork();
    if (made == 0) become(start, {arguments.data(), environment.data()}, (*report)[1]);
    int error = made < 0 ? errno : 0;
    ::close((*report)[1]);
    if (made > 0 && readSome((*report)[0], {reinterpret_cast<char*>(&error), sizeof error}) != sizeof error)
        error = 0;  // closed by the program that began
    ::close((*report)[0]);
    child.process = made;
    if (error != 0 && made > 0) waitForChild(child);
    return error;
}

void killChild(Child child) {
    ::kill(static_cast<pid_t>(child.process), SIGKILL);
}

ChildEnd waitForChild(Child child) {
    int status = 0;
    rusage usage{};
    while (::wait4(static_cast<pid_t>(child.process), &status, 0, &usage) < 0 && errno == EINTR) {
    }
    return {.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            .crashed = isCrash(status),
            .cpuSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime)};
}

std::optional<std::array<int, 2>> makePipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
    return ends;
}

int writePipe(int pipe, std::string_view bytes) {
    std::signal(SIGPIPE, SIG_IGN);  // it would end programs of the library's users
    while (!bytes.empty()) {
        const ssize_t count = ::write(pipe, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

bool readUntil(int pipe, Clock::time_point end, std::string& text) {
    std::array<char, 4096> part;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
        if (left.count() <= 0) return false;
        pollfd wanted{pipe, POLLIN, 0};
        const int ready = ::poll(&wanted, 1, static_cast<int>(left.count()));
        if (ready < 0 && errno != EINTR) return true;
        if (ready <= 0) continue;
        const std::ptrdiff_t count = readSome(pipe, part);
        if (count <= 0) return true;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
}

namespace {

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP};
std::array<void (*)(int), kStopSignals.size()> handlersBefore{};
// A signal handler may access nothing else.
volatile std::sig_atomic_t wasAsked = 0;

void ask(int) {
    wasAsked = 1;
}

}  // namespace

void catchStops() {
    wasAsked = 0;
    for (std::size_t k = 0; k < kStopSignals.size(); ++k) {
        handlersBefore[k] = std::signal(kStopSignals[k], ask);
        if (kStopSignals[k] == SIGHUP && handlersBefore[k] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
}

void releaseStops() {
    for (std::size_t k = 0; k < kStopSignals.size(); ++k) std::signal(kStopSignals[k], handlersBefore[k]);
}

bool isStopRequested() {
    return wasAsked != 0;
}

std::vector<std::string> prepareProgram(int argc, char** argv) {
    // glibc loads the library that unwinds threads at its first use, and aborts if there is no memory left
    // for it.
    void* frame = nullptr;
    ::backtrace(&frame, 1);
    // A reader that ends or a limit of file sizes makes a write fail; by default it would end the program,
    // even a server with players.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    return {argv, argv + argc};
}

bool isTerminal(int descriptor) {
    return ::isatty(descriptor) == 1;
}

bool isPipe(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode);
}

bool isOutputReaderGone() {
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

namespace {

fs::path absoluteFrom(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value ? value : "";
    return path.is_absolute() ? path : fs::path();
}

struct XdgFolder {
    const char* variable;
    const char* below;  // the home folder
};

// XDG Base Directory Specification. It says to ignore relative paths.
XdgFolder xdgFolder(UserFolder kind) {
    switch (kind) {
        case UserFolder::Data:
            return {"XDG_DATA_HOME", ".local/share"};
        case UserFolder::Settings:
            return {"XDG_CONFIG_HOME", ".config"};
        case UserFolder::Cache:
            break;
    }
    return {"XDG_CACHE_HOME", ".cache"};
}

}  // namespace

fs::path userFolder(UserFolder kind) {
    const XdgFolder folder = xdgFolder(kind);
    fs::path path = absoluteFrom(folder.variable);
    if (!path.empty()) return path;
    path = absoluteFrom("HOME");
    return path.empty() ? path : path / folder.below;
}

const char* dataFolderVariables() {
    return "XDG_DATA_HOME or HOME";
}

fs::path programFile() {
    return fmt::format("/proc/{}/exe", ::getpid());
}

namespace {

// The value of `key` in a file of lines "key: value" or "key=value"; empty if there is none.
std::string lineOf(const char* path, const std::string& key) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (!line.starts_with(key)) continue;
        const std::size_t start = line.find_first_not_of(" \t:=\"", key.size());
        const std::size_t end = line.find_last_not_of(" \t\"");
        if (start != std::string::npos) return line.substr(start, end - start + 1);
    }
    return {};
}

std::chrono::nanoseconds clockTime(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

std::string cpuName() {
    return lineOf("/proc/cpuinfo", "model name");
}

std::string systemName() {
    utsname names{};
    ::uname(&names);
    return fmt::format("{}, {} {}", lineOf("/etc/os-release", "PRETTY_NAME"), names.sysname, names.release);
}

std::string hostName() {
    char name[256] = "";
    return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

double memoryBytes() {
    return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double loadAverage() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

std::size_t residentBytes() {
    std::size_t total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::size_t peakResidentBytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

double cpuSeconds() {
    return std::chrono::duration<double>(clockTime(CLOCK_PROCESS_CPUTIME_ID)).count();
}

std::chrono::nanoseconds threadTime() {
    return clockTime(CLOCK_THREAD_CPUTIME_ID);
}

int processNumber() {
    return ::getpid();
}

void raiseOpenFileLimit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    (void)::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace terrane::base::platform
