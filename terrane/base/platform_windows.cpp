#define WIN32_LEAN_AND_MEAN
#define NOMINMAX

#include "terrane/base/platform.h"

// windows.h comes before the headers that need it.
#include <windows.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>
#include <process.h>
#include <psapi.h>
#include <shellapi.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <random>
#include <thread>

namespace terrane::base::platform {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::wstring wide(std::string_view text) {
    return fs::path(text).wstring();  // narrow paths are UTF-8
}

std::string narrow(std::wstring_view text) {
    return fs::path(text).string();
}

// The errno that a Unix system would give.
int errnoOf(DWORD error) {
    switch (error) {
        case ERROR_SUCCESS:
            return 0;
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_DRIVE:
        case ERROR_INVALID_NAME:
        case ERROR_BAD_PATHNAME:
        case ERROR_BAD_NETPATH:
        case ERROR_BAD_NET_NAME:
            return ENOENT;
        case ERROR_ACCESS_DENIED:
        case ERROR_SHARING_VIOLATION:
            return EACCES;
        case ERROR_LOCK_VIOLATION:
        case ERROR_IO_PENDING:
            return EWOULDBLOCK;
        case ERROR_FILE_EXISTS:
        case ERROR_ALREADY_EXISTS:
            return EEXIST;
        case ERROR_DISK_FULL:
        case ERROR_HANDLE_DISK_FULL:
            return ENOSPC;
        case ERROR_FILE_TOO_LARGE:
            return EFBIG;
        case ERROR_WRITE_PROTECT:
            return EROFS;
        case ERROR_DIRECTORY:
            return ENOTDIR;
        case ERROR_FILENAME_EXCED_RANGE:
            return ENAMETOOLONG;
        case ERROR_TOO_MANY_OPEN_FILES:
            return EMFILE;
        case ERROR_NOT_ENOUGH_MEMORY:
        case ERROR_OUTOFMEMORY:
            return ENOMEM;
        case ERROR_BROKEN_PIPE:
        case ERROR_NO_DATA:
            return EPIPE;
        case ERROR_INVALID_HANDLE:
            return EBADF;
        default:
            return EIO;
    }
}

int lastError() {
    return errnoOf(::GetLastError());
}

int errorOf(BOOL isDone) {
    return isDone ? 0 : lastError();
}

HANDLE handleOf(int descriptor) {
    return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
}

bool isFolder(const fs::path& path) {
    const DWORD attributes = ::GetFileAttributesW(path.c_str());
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

// Others may read, write, rename and delete the file meanwhile, as on Unix systems.
constexpr DWORD kShared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

HANDLE openHandle(const fs::path& path, DWORD access, DWORD creation, DWORD flags) {
    return ::CreateFileW(path.c_str(), access, kShared, nullptr, creation, flags, nullptr);
}

// Takes the handle.
int descriptorOf(HANDLE handle, int mode) {
    if (handle == INVALID_HANDLE_VALUE) return -1;
    const int descriptor =
        ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), mode | _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) ::CloseHandle(handle);
    return descriptor;
}

int openDescriptor(const fs::path& path, DWORD access, DWORD creation, DWORD flags) {
    const HANDLE handle = openHandle(path, access, creation, FILE_ATTRIBUTE_NORMAL | flags);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = isFolder(path) ? EISDIR : lastError();
        return -1;
    }
    return descriptorOf(handle, (access & GENERIC_WRITE) != 0 ? _O_RDWR : _O_RDONLY);
}

std::optional<FileStatus> statusOf(HANDLE handle) {
    BY_HANDLE_FILE_INFORMATION found{};
    if (::GetFileType(handle) != FILE_TYPE_DISK || !::GetFileInformationByHandle(handle, &found))
        return std::nullopt;
    const auto joined = [](DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; };
    const bool isFolder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    const bool isLink = (found.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
    return FileStatus{
        .isRegular = !isFolder && !isLink,
        .isFolder = isFolder,
        .sizeBytes = joined(found.nFileSizeHigh, found.nFileSizeLow),
        .nameCount = found.nNumberOfLinks,
        .identity = {found.dwVolumeSerialNumber, joined(found.nFileIndexHigh, found.nFileIndexLow)}};
}

OVERLAPPED at(std::uint64_t offsetBytes) {
    OVERLAPPED place{};
    place.Offset = static_cast<DWORD>(offsetBytes);
    place.OffsetHigh = static_cast<DWORD>(offsetBytes >> 32);
    return place;
}

}  // namespace

std::optional<FileStatus> statusOf(int descriptor) {
    const auto status = statusOf(handleOf(descriptor));
    return status ? status : FileStatus();  // a device or a pipe
}

std::optional<FileStatus> statusOf(const fs::path& path, Links links) {
    const DWORD flags =
        FILE_FLAG_BACKUP_SEMANTICS | (links == Links::Keep ? FILE_FLAG_OPEN_REPARSE_POINT : 0);
    const HANDLE handle = openHandle(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, flags);
    if (handle == INVALID_HANDLE_VALUE) return std::nullopt;
    const auto status = statusOf(handle);
    ::CloseHandle(handle);
    return status;
}

int openToRead(const fs::path& path) {
    return openDescriptor(path, GENERIC_READ, OPEN_EXISTING, 0);
}

// The folders of a user are closed to others, so files in them are too.
int createFile(const fs::path& path, Readers) {
    return openDescriptor(path, GENERIC_READ | GENERIC_WRITE, CREATE_NEW, 0);
}

int createUnnamed(const fs::path&) {
    errno = ENOTSUP;
    return -1;
}

int giveName(int, const fs::path&) {
    return ENOTSUP;
}

std::ptrdiff_t readSome(int descriptor, std::span<char> bytes) {
    DWORD count = 0;
    if (::ReadFile(handleOf(descriptor), bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr))
        return static_cast<std::ptrdiff_t>(count);
    if (::GetLastError() == ERROR_BROKEN_PIPE || ::GetLastError() == ERROR_HANDLE_EOF) return 0;
    errno = lastError();
    return -1;
}

std::ptrdiff_t readAt(int descriptor, std::span<char> bytes, std::uint64_t offsetBytes) {
    OVERLAPPED place = at(offsetBytes);
    DWORD count = 0;
    if (::ReadFile(handleOf(descriptor), bytes.data(), static_cast<DWORD>(bytes.size()), &count, &place))
        return static_cast<std::ptrdiff_t>(count);
    if (::GetLastError() == ERROR_HANDLE_EOF) return 0;
    errno = lastError();
    return -1;
}

int writeAt(int descriptor, std::string_view bytes, std::uint64_t offsetBytes) {
    constexpr std::size_t kMaxPart = std::size_t{1} << 30;  // a count of 32 bits
    while (!bytes.empty()) {
        OVERLAPPED place = at(offsetBytes);
        DWORD count = 0;
        if (!::WriteFile(handleOf(descriptor), bytes.data(),
                         static_cast<DWORD>(std::min(bytes.size(), kMaxPart)), &count, &place))
            return lastError();
        if (count == 0) return EIO;
        bytes.remove_prefix(count);
        offsetBytes += count;
    }
    return 0;
}

int truncate(int descriptor) {
    FILE_END_OF_FILE_INFO end{};
    return errorOf(::SetFileInformationByHandle(handleOf(descriptor), FileEndOfFileInfo, &end, sizeof end));
}

int reserve(int descriptor, std::uint64_t sizeBytes) {
    if (sizeBytes > static_cast<std::uint64_t>(INT64_MAX)) return EFBIG;
    if (sizeBytes == 0) return 0;
    FILE_ALLOCATION_INFO space{};
    space.AllocationSize.QuadPart = static_cast<LONGLONG>(sizeBytes);
    return errorOf(
        ::SetFileInformationByHandle(handleOf(descriptor), FileAllocationInfo, &space, sizeof space));
}

bool isNoRoom(int error) {
    return error == ENOSPC || error == EFBIG;
}

int flush(int descriptor) {
    return errorOf(::FlushFileBuffers(handleOf(descriptor)));
}

int flushFile(const fs::path& path) {
    const HANDLE handle = openHandle(path, GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING, 0);
    if (handle == INVALID_HANDLE_VALUE) return lastError();
    const int error = errorOf(::FlushFileBuffers(handle));
    ::CloseHandle(handle);
    return error;
}

// replaceFile() writes names through.
int flushFolder(const fs::path&) {
    return 0;
}

int closeFile(int descriptor) {
    return ::_close(descriptor) == 0 ? 0 : errno;
}

void takeMode(int, const fs::path&) {}

int replaceFile(const fs::path& from, const fs::path& to) {
    // Programs that look at new files, such as virus scanners, keep them open for a moment.
    constexpr int kAttempts = 100;
    constexpr std::chrono::milliseconds kPause{10};
    for (int attempt = 1;; ++attempt) {
        if (::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
            return 0;
        const DWORD error = ::GetLastError();
        const bool mayPass = error == ERROR_SHARING_VIOLATION || error == ERROR_ACCESS_DENIED;
        if (!mayPass || attempt == kAttempts || isFolder(to)) return errnoOf(error);
        std::this_thread::sleep_for(kPause);
    }
}

// Microsoft, "Naming Files, Paths, and Namespaces".
bool canBeFileName(std::string_view name) {
    constexpr std::array<std::string_view, 4> kDevices = {"CON", "PRN", "AUX", "NUL"};
    constexpr std::array<std::string_view, 2> kPorts = {"COM", "LPT"};
    if (name.find_first_of("<>:\"/\\|?*") != std::string_view::npos || name.ends_with('.') ||
        name.ends_with(' '))
        return false;
    std::string start(name.substr(0, name.find('.')));
    std::ranges::transform(start, start.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    const bool isPort = start.size() == 4 && start[3] >= '1' && start[3] <= '9' &&
                        std::ranges::count(kPorts, std::string_view(start).substr(0, 3)) > 0;
    return !isPort && std::ranges::count(kDevices, start) == 0;
}

// Rights are too many to compute: tries it.
bool isWritableFolder(const fs::path& folder) {
    fs::path made;
    if (makeFolder(folder / ".terrane-", made) != 0) return false;
    ::RemoveDirectoryW(made.c_str());
    return true;
}

int makeFolder(const fs::path& start, fs::path& made) {
    std::random_device random;
    for (;;) {
        made = start;
        made += fmt::format("{:08x}", random());
        if (::CreateDirectoryW(made.c_str(), nullptr)) return 0;
        if (::GetLastError() != ERROR_ALREADY_EXISTS) return lastError();
    }
}

int openLockFile(const fs::path& path, bool isShared) {
    const auto status = statusOf(path, Links::Keep);
    if (status && !status->isRegular && !status->isFolder) {
        errno = ELOOP;
        return -1;
    }
    const int descriptor = openDescriptor(path, GENERIC_READ | GENERIC_WRITE, OPEN_ALWAYS, 0);
    const bool isForbidden = descriptor < 0 && (errno == EACCES || errno == EROFS);
    return isForbidden && isShared ? openToRead(path) : descriptor;
}

// Locks a byte far behind the content, since others may not read locked bytes. The lock of before ends first:
// a handle has both kinds at the same time otherwise.
int tryLock(int descriptor, bool isShared) {
    constexpr std::uint64_t kLockedByte = std::uint64_t{1} << 62;
    OVERLAPPED place = at(kLockedByte);
    ::UnlockFileEx(handleOf(descriptor), 0, 1, 0, &place);
    place = at(kLockedByte);
    return errorOf(::LockFileEx(handleOf(descriptor),
                                LOCKFILE_FAIL_IMMEDIATELY | (isShared ? 0 : LOCKFILE_EXCLUSIVE_LOCK), 0, 1, 0,
                                &place));
}

namespace {

// As the C runtime of the child parses it: backslashes count double before a quotation mark.
std::wstring quoted(const std::wstring& argument) {
    if (!argument.empty() && argument.find_first_of(L" \t\n\v\"") == std::wstring::npos) return argument;
    std::wstring text = L"\"";
    std::size_t backslashes = 0;
    for (const wchar_t c : argument) {
        if (c == L'"') text.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        text += c;
    }
    text.append(backslashes, L'\\');
    return text + L'"';
}

std::wstring commandLine(const std::vector<std::string>& command) {
    std::wstring line;
    for (const std::string& argument : command) line += (line.empty() ? L"" : L" ") + quoted(wide(argument));
    return line;
}

// "NAME=value" texts, each with its final zero, and one more.
std::wstring environmentWith(std::span<const std::pair<std::string, std::string>> added) {
    std::wstring block;
    wchar_t* const inherited = ::GetEnvironmentStringsW();
    for (const wchar_t* text = inherited; text && *text; text += std::wcslen(text) + 1) {
        const bool isReplaced = std::ranges::any_of(added, [&](const auto& variable) {
            const std::wstring start = wide(variable.first) + L"=";
            return ::_wcsnicmp(text, start.c_str(), start.size()) == 0;
        });
        if (!isReplaced) block.append(text, std::wcslen(text) + 1);
    }
    if (inherited) ::FreeEnvironmentStringsW(inherited);
    for (const auto& [name, value] : added) block += wide(name) + L"=" + wide(value) + L'\0';
    return block + L'\0';
}

// A copy of a descriptor's handle, or of the null device's, that a child inherits.
HANDLE inherited(int descriptor) {
    HANDLE copy = INVALID_HANDLE_VALUE;
    if (descriptor >= 0) {
        ::DuplicateHandle(::GetCurrentProcess(), handleOf(descriptor), ::GetCurrentProcess(), &copy, 0, TRUE,
                          DUPLICATE_SAME_ACCESS);
        return copy;
    }
    SECURITY_ATTRIBUTES inheritable{sizeof inheritable, nullptr, TRUE};
    return ::CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE, kShared, &inheritable, OPEN_EXISTING, 0,
                         nullptr);
}

// Ends the processes in it when this process ends, however it does.
HANDLE jobOfThisProcess() {
    static const HANDLE job = [] {
        const HANDLE made = ::CreateJobObjectW(nullptr, nullptr);
        JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
        limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
        ::SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits);
        return made;
    }();
    return job;
}

double secondsOf(const FILETIME& time) {
    return static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime) * 1e-7;
}

// Exit codes of shells for the signals of such faults.
int exitCodeOf(DWORD code) {
    constexpr int kSegmentationFault = 128 + 11, kOtherFault = 128 + 6;
    if (code < 0xC0000000) return static_cast<int>(code);
    return code == STATUS_ACCESS_VIOLATION || code == STATUS_STACK_OVERFLOW ? kSegmentationFault
                                                                            : kOtherFault;
}

constexpr UINT kKilled = 128 + 9;

}  // namespace

int startChild(const ChildStart& start, Child& child) {
    std::wstring line = commandLine(start.command), environment = environmentWith(start.environment);
    // Only these handles are inherited, so that pipes of other children close when these end.
    std::array<HANDLE, 3> handles = {inherited(start.input), inherited(start.output),
                                     inherited(start.errors)};
    SIZE_T sizeBytes = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &sizeBytes);
    std::vector<std::byte> attributes(sizeBytes);
    STARTUPINFOEXW options{};
    options.StartupInfo.cb = sizeof options;
    options.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    options.StartupInfo.hStdInput = handles[0];
    options.StartupInfo.hStdOutput = handles[1];
    options.StartupInfo.hStdError = handles[2];
    options.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(attributes.data());
    ::InitializeProcThreadAttributeList(options.lpAttributeList, 1, 0, &sizeBytes);
    ::UpdateProcThreadAttribute(options.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles.data(),
                                sizeof handles, nullptr, nullptr);
    PROCESS_INFORMATION made{};
    const DWORD flags = CREATE_UNICODE_ENVIRONMENT | EXTENDED_STARTUPINFO_PRESENT | CREATE_SUSPENDED |
                        (start.isIndependent ? CREATE_NEW_PROCESS_GROUP : 0) |
                        (::GetConsoleWindow() ? 0 : CREATE_NO_WINDOW);
    const BOOL isStarted =
        ::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, flags, environment.data(),
                         start.folder.empty() ? nullptr : start.folder.c_str(), &options.StartupInfo, &made);
    const int error = errorOf(isStarted);
    ::DeleteProcThreadAttributeList(options.lpAttributeList);
    for (const HANDLE handle : handles) ::CloseHandle(handle);
    if (error != 0) return error;
    if (!start.isIndependent) ::AssignProcessToJobObject(jobOfThisProcess(), made.hProcess);
    ::ResumeThread(made.hThread);
    ::CloseHandle(made.hThread);
    child.process = reinterpret_cast<std::intptr_t>(made.hProcess);
    return 0;
}

void killChild(Child child) {
    ::TerminateProcess(reinterpret_cast<HANDLE>(child.process), kKilled);
}

ChildEnd waitForChild(Child child) {
    const auto process = reinterpret_cast<HANDLE>(child.process);
    ::WaitForSingleObject(process, INFINITE);
    DWORD code = 0;
    ::GetExitCodeProcess(process, &code);
    FILETIME began, ended, inSystem{}, inProgram{};
    ::GetProcessTimes(process, &began, &ended, &inSystem, &inProgram);
    ::CloseHandle(process);
    return {.exitCode = exitCodeOf(code),
            .crashed = code >= 0xC0000000,
            .cpuSeconds = secondsOf(inSystem) + secondsOf(inProgram)};
}

std::optional<std::array<int, 2>> makePipe() {
    HANDLE from = nullptr, to = nullptr;
    if (!::CreatePipe(&from, &to, nullptr, 0)) {
        errno = lastError();
        return std::nullopt;
    }
    return std::array{descriptorOf(from, _O_RDONLY), descriptorOf(to, _O_WRONLY)};
}

int writePipe(int pipe, std::string_view bytes) {
    while (!bytes.empty()) {
        DWORD count = 0;
        if (!::WriteFile(handleOf(pipe), bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr))
            return lastError();
        bytes.remove_prefix(count);
    }
    return 0;
}

// Pipes cannot be waited for with a time limit.
bool readUntil(int pipe, Clock::time_point end, std::string& text) {
    constexpr std::chrono::milliseconds kPause{5};
    std::array<char, 4096> part;
    while (Clock::now() < end) {
        DWORD available = 0;
        if (!::PeekNamedPipe(handleOf(pipe), nullptr, 0, nullptr, &available, nullptr)) return true;
        if (available == 0) {
            std::this_thread::sleep_for(kPause);
            continue;
        }
        const std::ptrdiff_t count = readSome(pipe, part);
        if (count <= 0) return true;
        text.append(part.data(), static_cast<std::size_t>(count));
    }
    return false;
}

namespace {

std::atomic<bool> wasAsked{false};

// Called on its own thread. The system ends the process when the handler of a closed console returns, and
// after a few seconds.
BOOL WINAPI ask(DWORD event) {
    wasAsked = true;
    if (event == CTRL_CLOSE_EVENT || event == CTRL_LOGOFF_EVENT || event == CTRL_SHUTDOWN_EVENT)
        ::Sleep(INFINITE);
    return TRUE;
}

}  // namespace

void catchStops() {
    wasAsked = false;
    ::SetConsoleCtrlHandler(ask, TRUE);
}

void releaseStops() {
    ::SetConsoleCtrlHandler(ask, FALSE);
}

bool isStopRequested() {
    return wasAsked;
}

std::vector<std::string> prepareProgram(int argc, char** argv) {
    for (const int stream : {0, 1, 2}) ::_setmode(stream, _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
    ::SetConsoleCP(CP_UTF8);
    std::setvbuf(stderr, nullptr, _IONBF, 0);
    // Errors of drives and faults are reported by the program, not in windows of the system.
    ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX | SEM_NOOPENFILEERRORBOX);
    // Those of main() lack characters outside the system's code page.
    int count = 0;
    wchar_t** const texts = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    if (!texts) return {argv, argv + argc};
    std::vector<std::string> arguments;
    for (int k = 0; k < count; ++k) arguments.push_back(narrow(texts[k]));
    ::LocalFree(texts);
    return arguments;
}

bool isTerminal(int descriptor) {
    DWORD mode = 0;
    return ::GetConsoleMode(handleOf(descriptor), &mode) != 0;
}

bool isPipe(int descriptor) {
    return ::GetFileType(handleOf(descriptor)) == FILE_TYPE_PIPE;
}

bool isOutputReaderGone() {
    DWORD none = 0;
    return isPipe(1) && !::WriteFile(handleOf(1), "", 0, &none, nullptr) &&
           (::GetLastError() == ERROR_NO_DATA || ::GetLastError() == ERROR_BROKEN_PIPE);
}

namespace {

fs::path absoluteFrom(const wchar_t* variable) {
    const wchar_t* value = ::_wgetenv(variable);
    const fs::path path = value ? value : L"";
    return path.is_absolute() ? path : fs::path();
}

}  // namespace

// The variables of Unix systems come first: scripts, and programs that start this one, use them on all
// systems.
fs::path userFolder(UserFolder kind) {
    const wchar_t* own = kind == UserFolder::Data       ? L"XDG_DATA_HOME"
                         : kind == UserFolder::Settings ? L"XDG_CONFIG_HOME"
                                                        : L"XDG_CACHE_HOME";
    const fs::path path = absoluteFrom(own);
    if (!path.empty()) return path;
    return absoluteFrom(kind == UserFolder::Cache ? L"LOCALAPPDATA" : L"APPDATA");
}

const char* dataFolderVariables() {
    return "XDG_DATA_HOME or APPDATA";
}

fs::path programFile() {
    std::wstring name(32768, L'\0');  // the longest path
    name.resize(::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
    return name;
}

namespace {

// A text of the registry; empty if there is none.
std::string registryText(const wchar_t* key, const wchar_t* name) {
    std::array<wchar_t, 256> text{};
    DWORD sizeBytes = sizeof text;
    if (::RegGetValueW(HKEY_LOCAL_MACHINE, key, name, RRF_RT_REG_SZ, nullptr, text.data(), &sizeBytes) !=
        ERROR_SUCCESS)
        return {};
    return narrow(text.data());
}

PROCESS_MEMORY_COUNTERS memoryOfProcess() {
    PROCESS_MEMORY_COUNTERS memory{};
    memory.cb = sizeof memory;
    ::GetProcessMemoryInfo(::GetCurrentProcess(), &memory, sizeof memory);
    return memory;
}

}  // namespace

std::string cpuName() {
    std::string name =
        registryText(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString");
    name.erase(name.find_last_not_of(' ') + 1);
    return name;
}

std::string systemName() {
    constexpr const wchar_t* kVersion = L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion";
    return fmt::format("{}, build {}", registryText(kVersion, L"ProductName"),
                       registryText(kVersion, L"CurrentBuildNumber"));
}

std::string hostName() {
    std::array<wchar_t, 256> name{};
    auto length = static_cast<DWORD>(name.size());
    return ::GetComputerNameExW(ComputerNameDnsHostname, name.data(), &length) ? narrow(name.data()) : "";
}

double memoryBytes() {
    MEMORYSTATUSEX memory{};
    memory.dwLength = sizeof memory;
    return ::GlobalMemoryStatusEx(&memory) ? static_cast<double>(memory.ullTotalPhys) : 0;
}

// The system counts no waiting programs.
double loadAverage() {
    return 0;
}

std::size_t residentBytes() {
    return memoryOfProcess().WorkingSetSize;
}

std::size_t peakResidentBytes() {
    return memoryOfProcess().PeakWorkingSetSize;
}

double cpuSeconds() {
    FILETIME began, ended, inSystem{}, inProgram{};
    ::GetProcessTimes(::GetCurrentProcess(), &began, &ended, &inSystem, &inProgram);
    return secondsOf(inSystem) + secondsOf(inProgram);
}

// In steps of the system's timer, about 16 ms.
std::chrono::nanoseconds threadTime() {
    FILETIME began, ended, inSystem{}, inProgram{};
    ::GetThreadTimes(::GetCurrentThread(), &began, &ended, &inSystem, &inProgram);
    return std::chrono::nanoseconds(
        static_cast<std::int64_t>((secondsOf(inSystem) + secondsOf(inProgram)) * 1e9));
}

int processNumber() {
    return ::_getpid();
}

void raiseOpenFileLimit() {
    constexpr int kMaxStreams = 8192;  // of the C runtime; sockets have no such limit
    ::_setmaxstdio(kMaxStreams);
}

}  // namespace terrane::base::platform
