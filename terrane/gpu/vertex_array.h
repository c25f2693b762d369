// A vertex array without attributes: shaders pull vertices from storage buffers. Core OpenGL draws nothing
// without one. Used on the thread of its context.
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

    // Indices for glDrawElements*; the buffer must outlive the vertex array.
    void setElementBuffer(const Buffer& indices) { glVertexArrayElementBuffer(id(), indices.id()); }

    void bind() const {
        assert(id() != 0 && "an empty vertex array cannot be bound");
        glBindVertexArray(id());
    }

    [[nodiscard]] GLuint id() const { return handle_.id(); }

  private:
    Handle<ObjectKind::VertexArray> handle_;
};

}  // namespace terrane::gpu
