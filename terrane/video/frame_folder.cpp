#include <cerrno>
#include <system_error>

#include "terrane/video/frame_sink.h"

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

}  // namespace terrane::video
