#include "apps/terrane/window/perf_log.h"

#include <fmt/ostream.h>

#include "terrane/base/process_statistics.h"

namespace terrane::app {

base::Result<PerfLog> PerfLog::create(const std::filesystem::path& file) {
    PerfLog log(file);
    fmt::print(log.out_,
               "time_s,frame_ms,fps,min_fps,max_fps,ram_mb,gpu_mb,active_chunks,visible_chunks,queued_chunks,"
               "opaque_triangles,transparent_triangles,load_or_generate_ms,own_light_ms,light_ms,mesh_ms,"
               "passes_ms\n");
    if (!log.out_) return base::fail("{}: cannot be written", file.string());
    return log;
}

void PerfLog::add(double seconds, double frameSeconds, const Statistics& f) {
    fmt::print(out_, "{:.4f},{:.3f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{},{},{},{},{}", seconds,
               frameSeconds * 1000, f.frames->now(), f.frames->min(), f.frames->max(),
               base::megabytes(f.memory.resident), base::megabytes(f.memory.quads + f.memory.lightOnGpu),
               f.activeChunks, f.progress.visible, f.queuedChunks, f.frame.opaqueTriangles,
               f.frame.transparentTriangles);
    for (std::size_t k = 0; k < f.tasks.size(); ++k) {
        const double before = tasks_.empty() ? 0 : tasks_[k].microseconds;
        fmt::print(out_, ",{:.3f}", (f.tasks[k].microseconds - before) / 1000);
    }
    double passes = 0;
    for (const gpu::GpuTiming& pass : *f.passes) passes += pass.milliseconds;
    fmt::print(out_, ",{:.3f}\n", passes);
    tasks_ = f.tasks;
}

base::Result<void> PerfLog::finish() {
    out_.close();
    if (!out_) return base::fail("{}: cannot be written", path_.string());
    return {};
}

}  // namespace terrane::app
