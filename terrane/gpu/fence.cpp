#include "terrane/gpu/fence.h"

namespace terrane::gpu {

Fence Fence::insert() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
}

Fence& Fence::operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
}

Fence::~Fence() {
    if (sync_ != nullptr) glDeleteSync(sync_);
}

bool Fence::passed() const {
    if (sync_ == nullptr) return true;
    const GLenum state = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    return state != GL_TIMEOUT_EXPIRED;
}

void Fence::wait() const {
    if (sync_ == nullptr) return;
    constexpr GLuint64 kStepNanoseconds = 100'000'000;  // drivers bound one wait; the loop does not
    while (glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, kStepNanoseconds) == GL_TIMEOUT_EXPIRED) {
    }
}

}  // namespace terrane::gpu
