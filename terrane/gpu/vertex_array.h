// A vertex array without vertex attributes: shaders pull vertices from buffers. Core OpenGL draws nothing
// without a vertex array. It is used on the thread of its context.
#pragma once

#include <cassert>
#include <string_view>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/handle.h"

namespace terrane::gpu {

class VertexArray {
  public:
    VertexArray() = default;
    explicit VertexArray(std::string_view label) {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        handle_ = Handle<ObjectKind::VertexArray>(id);
        handle_.label(label);
    }

    // Sets the indices for glDrawElements*; the buffer must outlive the vertex array.
    void setElementBuffer(const Buffer& indices) { glVertexArrayElementBuffer(id(), indices.id()); }

    // Reads `count` integers (1…4) for each instance from the start of every `strideBytes` of the buffer,
    // which must outlive its use; may be called again.
    void setInstanceIntegers(GLuint location, const Buffer& buffer, GLint count, std::size_t strideBytes) {
        glVertexArrayVertexBuffer(id(), location, buffer.id(), 0, static_cast<GLsizei>(strideBytes));
        glVertexArrayAttribIFormat(id(), location, count, GL_INT, 0);
        glVertexArrayAttribBinding(id(), location, location);
        glVertexArrayBindingDivisor(id(), location, 1);
        glEnableVertexArrayAttrib(id(), location);
    }

    void bind() const {
        assert(id() != 0 && "an empty vertex array cannot be bound");
        glBindVertexArray(id());
    }

    [[nodiscard]] GLuint id() const { return handle_.id(); }

  private:
    Handle<ObjectKind::VertexArray> handle_;
};

}  // namespace terrane::gpu
