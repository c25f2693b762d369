#include "terrane/video/frame_sink.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

extern char** environ;

namespace terrane::video {

namespace {

class FrameFolder : public FrameSink {
  public:
    explicit FrameFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    base::Result<void> add(const base::Image& frame) override {
        return base::writePng(folder_ / fmt::format("frame_{:05}.png", count_++), frame);
    }
    base::Result<void> finish() override { return {}; }

  private:
    std::filesystem::path folder_;
    int count_ = 0;
};

}  // namespace

base::Result<std::unique_ptr<FrameSink>> openFrameFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directory(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        return base::fail("{}: cannot be made: {}", folder.string(),
                          error ? error.message() : "it is not a folder");
    // Frames of an earlier video would mix with the new ones.
    const bool isEmpty = std::filesystem::is_empty(folder, error);
    if (error) return base::fail("{}: cannot be read: {}", folder.string(), error.message());
    if (!isEmpty) return base::fail("{}: the folder for frames is not empty", folder.string());
    return std::make_unique<FrameFolder>(folder);
}

namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// ffmpeg's name for the container of a file; empty if it is not known to work.
std::string containerOf(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".mp4" ? "mp4" : ending == ".mkv" ? "matroska" : "";
}

// Players take colors of HDTV sizes as BT.709, and all of them can play 4:2:0.
std::vector<std::string> argumentsFor(const std::filesystem::path& output, const std::string& container,
                                      const VideoFormat& format) {
    return {"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-f", "rawvideo", "-pixel_format",
            "rgba", "-video_size", fmt::format("{}x{}", format.size.x, format.size.y), "-framerate",
            std::to_string(format.framesPerSecond), "-i", "pipe:0", "-vf",
            "scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-preset", "medium", "-crf", "18",
            "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
            "-color_range", "tv", "-movflags", "+faststart", "-f", container, "-y",
            // With "file:" names that begin with a dash or have a colon are not taken as options or
            // protocols.
            "file:" + output.string()};
}

struct Child {
    pid_t id = -1;
    int input = -1;  // a pipe to its standard input
    File messages;   // its standard error
};

// Starts ffmpeg in its own process group: an interrupt from the keyboard reaches only this program, which
// then ends ffmpeg.
int spawn(std::vector<std::string> arguments, int readEnd, int messages, pid_t& id) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, readEnd, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int error = posix_spawnp(&id, pointers[0], &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

base::Result<Child> start(const std::vector<std::string>& arguments) {
    Child child;
    child.messages.reset(std::tmpfile());
    std::array<int, 2> ends{};
    if (!child.messages || pipe2(ends.data(), O_CLOEXEC) != 0)
        return base::fail("ffmpeg: cannot be started: {}", base::systemReason(errno));
    const int error = spawn(arguments, ends[0], fileno(child.messages.get()), child.id);
    close(ends[0]);
    child.input = ends[1];
    if (error == 0) return child;
    close(child.input);
    if (error == ENOENT)
        return base::fail(
            "ffmpeg: not found; install it (Debian: apt-get install ffmpeg) or use --frames-dir");
    return base::fail("ffmpeg: cannot be started: {}", base::systemReason(error));
}

class VideoFile : public FrameSink {
  public:
    VideoFile(Child child, std::filesystem::path file, std::filesystem::path unfinished)
        : child_(std::move(child)), file_(std::move(file)), unfinished_(std::move(unfinished)) {}

    ~VideoFile() override {
        if (child_.id < 0) return;
        kill(child_.id, SIGKILL);
        end();
    }

    base::Result<void> add(const base::Image& frame) override {
        const std::uint8_t* at = frame.rgba.data();
        for (std::size_t left = frame.rgba.size(); left > 0;) {
            const ssize_t written = write(child_.input, at, left);
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return failed();  // a broken pipe: ffmpeg's messages have the reason
            at += written;
            left -= static_cast<std::size_t>(written);
        }
        return {};
    }

    base::Result<void> finish() override {
        close(child_.input);
        child_.input = -1;
        int status = 0;
        waitForChild(status);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return failed();
        std::error_code error;
        std::filesystem::rename(unfinished_, file_, error);
        if (!error) return {};
        end();
        return base::fail("{}: cannot be written: {}", file_.string(), error.message());
    }

  private:
    void waitForChild(int& status) {
        while (waitpid(child_.id, &status, 0) < 0 && errno == EINTR) {
        }
        child_.id = -1;
    }

    // Waits for ffmpeg and removes its file.
    void end() {
        if (child_.input >= 0) close(child_.input);
        child_.input = -1;
        int ignoredStatus = 0;
        if (child_.id >= 0) waitForChild(ignoredStatus);
        std::error_code ignored;
        std::filesystem::remove(unfinished_, ignored);
    }

    base::Result<void> failed() {
        end();
        return base::fail("{}: ffmpeg could not make it: {}", file_.string(), lastMessage());
    }

    std::string lastMessage() const {
        std::array<char, 1024> line{};
        std::string last = "it reported no reason";
        std::rewind(child_.messages.get());
        while (std::fgets(line.data(), line.size(), child_.messages.get())) {
            std::string text = line.data();
            text.erase(text.find_last_not_of("\r\n ") + 1);
            if (!text.empty()) last = text;
        }
        return last;
    }

    Child child_;
    std::filesystem::path file_, unfinished_;
};

}  // namespace

base::Result<std::unique_ptr<FrameSink>> openVideo(const std::filesystem::path& file,
                                                   const VideoFormat& format) {
    const std::string container = containerOf(file);
    if (container.empty()) return base::fail("{}: a video ends in .mp4 or .mkv", file.string());
    if (format.size.x % 2 != 0 || format.size.y % 2 != 0)
        return base::fail("--size: a video has even sides, got {}x{}", format.size.x, format.size.y);
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(file, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return base::fail("{}: cannot be written: it is not a regular file", file.string());
    std::filesystem::path unfinished = file;
    unfinished += fmt::format(".part{}", getpid());
    std::signal(SIGPIPE, SIG_IGN);  // so that writing to an ended ffmpeg returns an error
    auto child = TERRANE_TRY(start(argumentsFor(unfinished, container, format)));
    return std::make_unique<VideoFile>(std::move(child), file, unfinished);
}

}  // namespace terrane::video
