#include "terrane/gpu/timer.h"

#include <cassert>

namespace terrane::gpu {
namespace {

GLuint64 timestamp(const Handle<ObjectKind::Query>& query) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &nanoseconds);
    return nanoseconds;
}

}  // namespace

void GpuTimer::nextFrame() {
    assert(open_.empty() && "zones end within their frame");
    if (recording_) {
        frames_[current_].pending = frames_[current_].usedZones > 0;
        current_ = (current_ + 1) % kFrames;
    }
    // From the oldest to the newest, so that the newest results stay.
    for (std::size_t i = 0; i < kFrames; ++i) {
        Frame& frame = frames_[(current_ + i) % kFrames];
        if (!frame.pending) continue;
        if (!finished(frame)) break;
        readResults(frame);
        frame.pending = false;
    }
    recording_ = !frames_[current_].pending;
    if (recording_) frames_[current_].usedZones = 0;
}

void GpuTimer::begin(std::string_view name) {
    if (!recording_) return;
    Frame& frame = frames_[current_];
    if (frame.usedZones == frame.zones.size())
        frame.zones.push_back({{}, createQuery(GL_TIMESTAMP), createQuery(GL_TIMESTAMP)});
    open_.push_back(frame.usedZones);
    Zone& zone = frame.zones[frame.usedZones++];
    zone.name = name;
    glQueryCounter(zone.begin.id(), GL_TIMESTAMP);
}

void GpuTimer::end() {
    if (!recording_) return;
    assert(!open_.empty() && "begin starts every zone");
    Frame& frame = frames_[current_];
    frame.lastEnded = open_.back();
    open_.pop_back();
    glQueryCounter(frame.zones[frame.lastEnded].end.id(), GL_TIMESTAMP);
}

bool GpuTimer::finished(const Frame& frame) {
    // Timestamps are taken in order: once the last one is available, all of the frame are.
    GLint available = GL_FALSE;
    glGetQueryObjectiv(frame.zones[frame.lastEnded].end.id(), GL_QUERY_RESULT_AVAILABLE, &available);
    return available != GL_FALSE;
}

void GpuTimer::readResults(const Frame& frame) {
    results_.clear();
    for (std::size_t i = 0; i < frame.usedZones; ++i) {
        const Zone& zone = frame.zones[i];
        const GLuint64 nanoseconds = timestamp(zone.end) - timestamp(zone.begin);
        results_.push_back({zone.name, static_cast<double>(nanoseconds) * 1e-6});
    }
}

}  // namespace terrane::gpu
