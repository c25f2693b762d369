// The owner of one OpenGL name. Every GL type of this module holds one: 0 is the empty state, moving leaves 0
// behind, destroying deletes the object. It is used on the thread whose context made the object, while that
// context is current.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <string_view>
#include <utility>

namespace terrane::gpu {

enum class ObjectKind : std::uint8_t {
    Buffer,
    Texture,
    Sampler,
    Framebuffer,
    VertexArray,
    Query,
    Shader,
    Program
};

void deleteObject(ObjectKind kind, GLuint id);

// Sets the name that debuggers and driver messages show. Names longer than the driver takes are cut off.
void labelObject(ObjectKind kind, GLuint id, std::string_view label);

template <ObjectKind kKind>
class Handle {
  public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        Handle old(std::exchange(id_, std::exchange(other.id_, 0)));
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ != 0) deleteObject(kKind, id_);
    }

    [[nodiscard]] GLuint id() const { return id_; }
    void label(std::string_view text) const { labelObject(kKind, id_, text); }

  private:
    GLuint id_ = 0;
};

// Returns a query object for a target such as GL_TIMESTAMP.
[[nodiscard]] Handle<ObjectKind::Query> createQuery(GLenum target);

}  // namespace terrane::gpu
