#include "terrane/video/frame_sink.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include "terrane/base/platform.h"

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

namespace platform = base::platform;

struct Encoder {
    platform::Child process;
    bool isRunning = false;
    int input = -1;  // a pipe to its standard input
    File messages;   // its standard error
};

// An interrupt from the keyboard reaches only this program, which then ends ffmpeg.
base::Result<Encoder> start(const std::vector<std::string>& arguments) {
    Encoder encoder;
    encoder.messages.reset(std::tmpfile());
    const auto ends = encoder.messages ? platform::makePipe() : std::nullopt;
    if (!ends) return base::fail("ffmpeg: cannot be started: {}", base::systemReason(errno));
    const int error = platform::startChild({.command = arguments,
                                            .folder = {},
                                            .environment = {},
                                            .input = (*ends)[0],
                                            .errors = fileno(encoder.messages.get()),
                                            .isIndependent = true},
                                           encoder.process);
    platform::closeFile((*ends)[0]);
    encoder.input = (*ends)[1];
    encoder.isRunning = error == 0;
    if (error == 0) return encoder;
    platform::closeFile(encoder.input);
    if (error == ENOENT)
        return base::fail(
            "ffmpeg: not found; install it (Debian: apt-get install ffmpeg) or use --frames-dir");
    return base::fail("ffmpeg: cannot be started: {}", base::systemReason(error));
}

class VideoFile : public FrameSink {
  public:
    VideoFile(Encoder encoder, std::filesystem::path file, std::filesystem::path unfinished)
        : encoder_(std::move(encoder)), file_(std::move(file)), unfinished_(std::move(unfinished)) {}

    ~VideoFile() override {
        if (!encoder_.isRunning) return;
        platform::killChild(encoder_.process);
        end();
    }

    base::Result<void> add(const base::Image& frame) override {
        const std::string_view bytes(reinterpret_cast<const char*>(frame.rgba.data()), frame.rgba.size());
        // A broken pipe: ffmpeg's messages have the reason.
        return platform::writePipe(encoder_.input, bytes) == 0 ? base::Result<void>() : failed();
    }

    base::Result<void> finish() override {
        if (wait() != 0) return failed();
        std::error_code error;
        std::filesystem::rename(unfinished_, file_, error);
        if (!error) return {};
        end();
        return base::fail("{}: cannot be written: {}", file_.string(), error.message());
    }

  private:
    // Ends ffmpeg's input and waits for it: its exit code.
    int wait() {
        platform::closeFile(std::exchange(encoder_.input, -1));
        encoder_.isRunning = false;
        return platform::waitForChild(encoder_.process).exitCode;
    }

    // Waits for ffmpeg and removes its file.
    void end() {
        if (encoder_.isRunning) wait();
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
        std::rewind(encoder_.messages.get());
        while (std::fgets(line.data(), line.size(), encoder_.messages.get())) {
            std::string text = line.data();
            text.erase(text.find_last_not_of("\r\n ") + 1);
            if (!text.empty()) last = text;
        }
        return last;
    }

    Encoder encoder_;
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
    unfinished += fmt::format(".part{}", platform::processNumber());
    auto encoder = TERRANE_TRY(start(argumentsFor(unfinished, container, format)));
    return std::make_unique<VideoFile>(std::move(encoder), file, unfinished);
}

}  // namespace terrane::video
