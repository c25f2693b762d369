// Textures that are drawn into together. The textures must outlive the framebuffer. It is used on the thread
// of its context.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/gpu/handle.h"
#include "terrane/gpu/texture.h"

namespace terrane::gpu {

// Level 0 of a texture, or of one layer of an array. It refers to the texture by its GL name and must not
// outlive it.
struct Attachment {
    Attachment() = default;
    Attachment(const Texture2D& texture);
    Attachment(const Texture2DMultisample& texture);
    Attachment(const Texture2DArray& texture, int layer);

    GLuint texture = 0;
    glm::ivec2 size = {0, 0};
    int samples = 0;
    int layer = -1;  // −1: the texture is no array
};

struct FramebufferOptions {
    std::vector<Attachment> colors;
    Attachment depth;  // empty for none
};

class Framebuffer {
  public:
    // Creates a framebuffer. It fails if the driver cannot draw into this combination.
    [[nodiscard]] static base::Result<Framebuffer> create(const FramebufferOptions& options,
                                                          std::string_view label);
    Framebuffer() = default;

    // Binds the framebuffer for draws, over its whole size.
    void bind() const;
    void clearColor(int index, glm::vec4 color) const;
    void clearDepth(float depth) const;

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    [[nodiscard]] glm::ivec2 size() const { return size_; }
    [[nodiscard]] int colorCount() const { return colorCount_; }
    [[nodiscard]] int samples() const { return samples_; }

  private:
    Handle<ObjectKind::Framebuffer> handle_;
    glm::ivec2 size_ = {0, 0};
    int colorCount_ = 0;
    bool hasDepth_ = false;
    int samples_ = 0;  // 0: not multisampled
};

// Copies one color attachment, scaled to the whole window.
void blitToWindow(const Framebuffer& from, int colorIndex, glm::ivec2 windowSize, GLenum filter);
void clearWindow(glm::vec3 color);  // sRGB, as the screen shows it

// Reads the colors as 8 bits a channel, the top row first. Waits for the GPU. The framebuffer must not be
// multisampled.
[[nodiscard]] base::Image readPixels(const Framebuffer& from, int colorIndex = 0);

}  // namespace terrane::gpu
