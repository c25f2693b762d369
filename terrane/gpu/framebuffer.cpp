#include "terrane/gpu/framebuffer.h"

#include <cassert>
#include <cstring>

namespace terrane::gpu {
namespace {

GLenum colorPoint(int index) {
    return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index);
}

void attach(GLuint framebuffer, GLenum point, const Attachment& attachment) {
    assert(attachment.texture != 0 && "an empty texture cannot be drawn into");
    if (attachment.layer < 0) {
        glNamedFramebufferTexture(framebuffer, point, attachment.texture, 0);
    } else {
        glNamedFramebufferTextureLayer(framebuffer, point, attachment.texture, 0, attachment.layer);
    }
}

// Draws write all colors, in the order of their attachments.
void setDrawBuffers(GLuint framebuffer, int colorCount) {
    std::vector<GLenum> points;
    for (int i = 0; i < colorCount; ++i) points.push_back(colorPoint(i));
    if (points.empty()) points.push_back(GL_NONE);
    glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(points.size()), points.data());
}

std::string_view statusName(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "a texture's format or level cannot be drawn into";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "it has no attachment";
        case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
            return "the numbers of samples differ";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "only some attachments are layered";
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "the driver does not support this combination of formats";
        default:
            return "unknown reason";
    }
}

}  // namespace

Attachment::Attachment(const Texture2D& source) : texture(source.id()), size(source.size()) {}

Attachment::Attachment(const Texture2DMultisample& source)
    : texture(source.id()), size(source.size()), samples(source.samples()) {}

Attachment::Attachment(const Texture2DArray& source, int layerNumber)
    : texture(source.id()), size(source.shape().size), layer(layerNumber) {}

base::Result<Framebuffer> Framebuffer::create(const FramebufferOptions& options, std::string_view label) {
    assert((!options.colors.empty() || options.depth.texture != 0) && "a framebuffer has an attachment");
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    Framebuffer result;
    result.handle_ = Handle<ObjectKind::Framebuffer>(id);
    result.handle_.label(label);
    result.colorCount_ = static_cast<int>(options.colors.size());
    result.hasDepth_ = options.depth.texture != 0;

    const Attachment& first = options.colors.empty() ? options.depth : options.colors.front();
    result.size_ = first.size;
    result.samples_ = first.samples;
    for (int i = 0; i < result.colorCount_; ++i) {
        const Attachment& color = options.colors[static_cast<std::size_t>(i)];
        assert(color.size == first.size && "all attachments have one size");
        attach(id, colorPoint(i), color);
    }
    if (result.hasDepth_) {
        assert(options.depth.size == first.size && "all attachments have one size");
        attach(id, GL_DEPTH_ATTACHMENT, options.depth);
    }
    setDrawBuffers(id, result.colorCount_);
    if (result.colorCount_ == 0) glNamedFramebufferReadBuffer(id, GL_NONE);

    const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return base::fail("framebuffer {} ({} x {}, {} samples): {} ({:#x})", label, first.size.x,
                          first.size.y, first.samples, statusName(status), status);
    return result;
}

void Framebuffer::bind() const {
    assert(id() != 0 && "an empty framebuffer is not the window");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id());
    glViewport(0, 0, size_.x, size_.y);
}

void Framebuffer::clearColor(int index, glm::vec4 color) const {
    assert(index >= 0 && index < colorCount_ && "the color attachment exists");
    glClearNamedFramebufferfv(id(), GL_COLOR, index, &color.x);
}

void Framebuffer::clearDepth(float depth) const {
    assert(hasDepth_ && "the framebuffer has a depth attachment");
    glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

void blitToWindow(const Framebuffer& from, int colorIndex, glm::ivec2 windowSize, GLenum filter) {
    assert(colorIndex >= 0 && colorIndex < from.colorCount() && "the color attachment exists");
    glNamedFramebufferReadBuffer(from.id(), colorPoint(colorIndex));
    const glm::ivec2 size = from.size();
    glBlitNamedFramebuffer(from.id(), 0, 0, 0, size.x, size.y, 0, 0, windowSize.x, windowSize.y,
                           GL_COLOR_BUFFER_BIT, filter);
}

void clearWindow(glm::vec3 color) {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glClearColor(color.r, color.g, color.b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

base::Image readPixels(const Framebuffer& from, int colorIndex) {
    assert(from.samples() == 0 && "samples are resolved before they are read");
    assert(colorIndex >= 0 && colorIndex < from.colorCount() && "the color attachment exists");
    const glm::ivec2 size = from.size();
    const std::size_t rowBytes = static_cast<std::size_t>(size.x) * 4;
    const auto rows = static_cast<std::size_t>(size.y);
    std::vector<std::uint8_t> bottomUp(rowBytes * rows);
    GLint bound = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());  // glReadPixels has no form with direct state access
    glNamedFramebufferReadBuffer(from.id(), colorPoint(colorIndex));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, bottomUp.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));

    base::Image image;
    image.width = size.x;
    image.height = size.y;
    image.rgba.resize(bottomUp.size());
    for (std::size_t row = 0; row < rows; ++row)
        std::memcpy(&image.rgba[row * rowBytes], &bottomUp[(rows - 1 - row) * rowBytes], rowBytes);
    return image;
}

}  // namespace terrane::gpu
