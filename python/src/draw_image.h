// Draws images of an opened world without a window. A thread has an OpenGL context of its own, so contexts of
// the caller stay unchanged.
#pragma once

#include <condition_variable>
#include <deque>
#include <future>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/pack/content.h"
#include "terrane/volume/opened_world.h"
#include "terrane/world/pose.h"

namespace terrane::python {

constexpr int kMaxImageSide = 8192;                       // pixels
constexpr int kMaxViewDistance = 64, kMaxHorizon = 4096;  // chunks

// Values are in the ranges of render().
struct ImageRequest {
    world::Pose pose;
    glm::ivec2 size{0};     // pixels: width, height
    float fieldOfView = 0;  // degrees, vertical
    float timeDay = 0;      // 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk
    int viewDistance = 0;   // chunks in full detail
    int horizon = 0;        // chunks up to which coarse terrain is drawn; 0: none
    std::string preset;     // one of render::presetNames()
};

struct DrawnWorld {
    std::shared_ptr<volume::OpenedWorld> opened;
    pack::Content content;  // that it was opened with
    unsigned threads = 1;
    bool isOnlyWriter = false;  // all changes are made through `opened`
};

// Draws one image after the other. Context, renderer, and the chunks of the last image are kept for the next
// one; after an error they are made anew. The first image makes them.
class ImageDrawer {
  public:
    // OutOfResources if no thread can be started.
    [[nodiscard]] static base::Result<std::shared_ptr<ImageDrawer>> create(DrawnWorld world);
    ~ImageDrawer();  // stop()
    ImageDrawer(const ImageDrawer&) = delete;
    ImageDrawer& operator=(const ImageDrawer&) = delete;

    // Waits for the image. Any thread. Failed if the machine cannot draw, and after stop().
    [[nodiscard]] base::Result<base::Image> draw(const ImageRequest& request);
    // Completes the image in progress, refuses those that wait, and ends the thread. Any thread.
    void stop();

  private:
    struct Waiting {
        ImageRequest request;
        std::promise<base::Result<base::Image>> image;
    };

    explicit ImageDrawer(DrawnWorld world) : world_(std::move(world)) {}
    void run();
    std::optional<Waiting> nextRequest();  // waits; none after stop()

    const DrawnWorld world_;
    std::mutex mutex_, stopMutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    bool isStopped_ = false;
    std::thread thread_;
};

}  // namespace terrane::python
