// The destination of the frames of a video: a file that ffmpeg writes, or a folder of images. One thread uses
// it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>

#include "terrane/base/image.h"
#include "terrane/base/result.h"

namespace terrane::video {

class FrameSink {
  public:
    virtual ~FrameSink() = default;  // removes an unfinished file unless finish() was called
    virtual base::Result<void> add(const base::Image& frame) = 0;
    virtual base::Result<void> finish() = 0;
};

// Writes frame_00000.png and so on. Creates the folder if needed; an existing one must be empty.
base::Result<std::unique_ptr<FrameSink>> openFrameFolder(const std::filesystem::path& folder);

struct VideoFormat {
    glm::ivec2 size{0};  // pixels, both even
    int framesPerSecond = 30;
};

// Encodes H.264 into .mp4 or .mkv with the program ffmpeg. The file appears complete with finish().
base::Result<std::unique_ptr<FrameSink>> openVideo(const std::filesystem::path& file,
                                                   const VideoFormat& format);

}  // namespace terrane::video
