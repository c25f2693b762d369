// What differs between systems: files, child processes, interrupts, the console, folders of the user, and the
// machine. platform_posix.cpp and platform_windows.cpp implement it.
//
// A descriptor is the number of an open file. Functions that make one return -1 and set errno if they fail.
// Other functions that return an int return 0 or an errno, on Windows too, so that messages are the same. Any
// thread may call functions unless their comments say otherwise.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::base::platform {

// Files. Child processes inherit no descriptor.

using FileIdentity = std::pair<std::uint64_t, std::uint64_t>;  // equal: the same file of the same disk

struct FileStatus {
    bool isRegular = false, isFolder = false;
    std::uint64_t sizeBytes = 0;
    std::uint64_t nameCount = 0;  // hard links
    FileIdentity identity;
};
std::optional<FileStatus> statusOf(int descriptor);
// Of a symbolic link itself, or of its target.
enum class Links : std::uint8_t { Follow, Keep };
std::optional<FileStatus> statusOf(const std::filesystem::path& path, Links links);

int openToRead(const std::filesystem::path& path);  // does not wait for the writer of a pipe
enum class Readers : std::uint8_t { Everybody, Owner };
int createFile(const std::filesystem::path& path, Readers readers);  // EEXIST if there is one

// Opens a file without a name in a folder, which vanishes unless giveName() gives it one; fails if the file
// system or the system has no such files.
int createUnnamed(const std::filesystem::path& folder);
int giveName(int descriptor, const std::filesystem::path& path);

// Returns the number of bytes read from the file's position; 0 at its end, negative with errno after an
// error.
std::ptrdiff_t readSome(int descriptor, std::span<char> bytes);
std::ptrdiff_t readAt(int descriptor, std::span<char> bytes, std::uint64_t offsetBytes);
int writeAt(int descriptor, std::string_view bytes, std::uint64_t offsetBytes);  // all of them
int truncate(int descriptor);                                                    // to no bytes
int reserve(int descriptor, std::uint64_t sizeBytes);                            // disk space
bool isNoRoom(int error);   // of the disk, the quota, or the largest file
int flush(int descriptor);  // returns when the data is on the disk
int flushFile(const std::filesystem::path& path);
int flushFolder(const std::filesystem::path& path);  // names of its files; not all file systems support it
int closeFile(int descriptor);                       // may report what writing could not
// Gives the file the mode of the file at the path, which may be readable by its owner only.
void takeMode(int descriptor, const std::filesystem::path& path);
// Renames a file, also over another one: readers see one of the two.
int replaceFile(const std::filesystem::path& from, const std::filesystem::path& to);

// False for names that mean devices or have characters with a meaning, where the system has such.
bool canBeFileName(std::string_view name);
bool isWritableFolder(const std::filesystem::path& folder);
// Makes a folder that only its owner may open, with a new name that begins with `start`.
int makeFolder(const std::filesystem::path& start, std::filesystem::path& made);

// Opens or creates a file for a lock, without following a symbolic link (ELOOP). Without the right to write
// it, `isShared` opens it for reading.
int openLockFile(const std::filesystem::path& path, bool isShared);
// Locks an open file against other programs, or changes the kind of its lock. Does not wait: EWOULDBLOCK.
int tryLock(int descriptor, bool isShared);

// Child processes.

struct ChildStart {
    const std::vector<std::string>& command;
    std::filesystem::path folder;                                      // empty: this program's
    std::span<const std::pair<std::string, std::string>> environment;  // added to the inherited variables
    int input = -1, output = -1, errors = -1;  // descriptors of its standard streams; -1: nothing
    // It outlives a killed caller, and interrupts from the keyboard do not reach it. Otherwise it is killed
    // when the calling thread ends.
    bool isIndependent = false;
};
struct Child {
    std::intptr_t process = 0;
};
int startChild(const ChildStart& start, Child& child);  // ENOENT if there is no such program
void killChild(Child child);

struct ChildEnd {
    int exitCode = 0;      // 128 + the signal that ended it
    bool crashed = false;  // by a fault of the program or of a driver
    double cpuSeconds = 0;
};
ChildEnd waitForChild(Child child);  // once

std::optional<std::array<int, 2>> makePipe();     // the end to read, the end to write
int writePipe(int pipe, std::string_view bytes);  // all of them; EPIPE if its reader ended
// Reads a pipe until its writers close it; false if the time runs out first.
bool readUntil(int pipe, std::chrono::steady_clock::time_point end, std::string& text);

// Interrupts. One thread calls them, in pairs: see StopSignals (process.h).

void catchStops();
void releaseStops();
bool isStopRequested();

// The console. The standard streams have the descriptors 0, 1 and 2.

// Called once by main(), first: failed writes return errors instead of ending the program, and standard
// streams carry the same bytes on all systems, as UTF-8. Returns the arguments of main(), as UTF-8.
std::vector<std::string> prepareProgram(int argc, char** argv);
bool isTerminal(int descriptor);
bool isPipe(int descriptor);
bool isOutputReaderGone();  // standard output is a pipe whose reader has ended

// Folders.

enum class UserFolder : std::uint8_t { Data, Settings, Cache };
// The user's folder for the files of all programs; empty if the environment names no absolute path.
std::filesystem::path userFolder(UserFolder kind);
// The variables that name the folder of data: "XDG_DATA_HOME or HOME".
const char* dataFolderVariables();
// The program's own file. If it is replaced meanwhile, it may still name the one that runs.
std::filesystem::path programFile();

// The machine and this process: see machine.h.

std::string cpuName();
std::string systemName();
std::string hostName();  // may be empty
double memoryBytes();
double loadAverage();
std::size_t residentBytes();
std::size_t peakResidentBytes();
double cpuSeconds();
std::chrono::nanoseconds threadTime();
int processNumber();
void raiseOpenFileLimit();

}  // namespace terrane::base::platform
