#include "apps/terrane/window/game/perf_log.h"

#include <fmt/ostream.h>

#include <algorithm>

#include "terrane/base/machine.h"
#include "terrane/render/frame/frame.h"

namespace terrane::app {
namespace {

std::string columnName(std::string_view pass) {
    std::string name(pass);
    std::ranges::replace(name, ' ', '_');
    return name;
}

}  // namespace

base::Result<PerfLog> PerfLog::create(const std::filesystem::path& file) {
    PerfLog log(file);
    fmt::print(
        log.out_,
        "time_s,frame_ms,fps,min_fps,max_fps,frames_of_second,ram_mb,gpu_mb,active_chunks,visible_chunks,"
        "queued_chunks,opaque_triangles,transparent_triangles,shadow_triangles,load_ms,generate_ms,"
        "make_deeper_ms,local_light_ms,light_ms,mesh_ms,tile_ms,passes_ms");
    for (const std::string_view pass : render::passNames()) fmt::print(log.out_, ",{}_ms", columnName(pass));
    fmt::print(log.out_, "\n");
    if (!log.out_) return base::fail("{}: cannot be written", file.string());
    return log;
}

void PerfLog::add(double seconds, double frameSeconds, const Statistics& f) {
    fmt::print(out_, "{:.4f},{:.3f},{:.1f},{:.1f},{:.1f},{},{:.1f},{:.1f},{},{},{},{},{},{}", seconds,
               frameSeconds * 1000, f.frames->now(), f.frames->min(), f.frames->max(), f.frames->lastSecond(),
               base::megabytes(f.memory.resident), base::megabytes(f.memory.quads + f.memory.lightOnGpu),
               f.activeChunks, f.progress.visible, f.queuedChunks, f.frame.opaqueTriangles,
               f.frame.transparentTriangles, f.frame.shadowTriangles);
    for (std::size_t k = 0; k < f.tasks.size(); ++k) {
        const double before = tasks_.empty() ? 0 : tasks_[k].microseconds;
        fmt::print(out_, ",{:.3f}", (f.tasks[k].microseconds - before) / 1000);
    }
    double passes = 0;
    for (const gpu::GpuTiming& pass : *f.passes) passes += pass.milliseconds;
    fmt::print(out_, ",{:.3f}", passes);
    for (const std::string_view name : render::passNames()) {
        const auto pass = std::ranges::find(*f.passes, name, &gpu::GpuTiming::name);
        fmt::print(out_, ",{:.3f}", pass == f.passes->end() ? 0 : pass->milliseconds);
    }
    fmt::print(out_, "\n");
    tasks_ = f.tasks;
}

base::Result<void> PerfLog::finish() {
    out_.close();
    if (!out_) return base::fail("{}: cannot be written", path_.string());
    return {};
}

}  // namespace terrane::app
