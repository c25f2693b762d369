// Where the frames of a video go: a file made by ffmpeg, or a folder of images. One thread.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "terrane/base/image.h"
#include "terrane/base/result.h"

namespace terrane::video {

class FrameSink {
  public:
    virtual ~FrameSink() = default;  // without finish() before it, an unfinished file is removed
    virtual base::Result<void> add(const base::Image& frame) = 0;
    virtual base::Result<void> finish() = 0;
};

// frame_00000.png and so on. The folder is made, or is there and empty.
base::Result<std::unique_ptr<FrameSink>> openFrameFolder(const std::filesystem::path& folder);

struct VideoFormat {
    glm::ivec2 size{0};  // pixels, both even
    int framesPerSecond = 30;
};

// H.264 in .mp4 or .mkv, by the program ffmpeg. The file appears with finish(), complete.
base::Result<std::unique_ptr<FrameSink>> openVideo(const std::filesystem::path& file,
                                                   const VideoFormat& format);

}  // namespace terrane::video
