// The figures that this program is to reach on two cores without a graphics card, and what it does reach.
#include <fmt/format.h>

#include "apps/terrane/bench/bench_cells.h"

namespace terrane::app {
namespace {

// The time of a task for each chunk in view; milliseconds.
Value taskPerChunk(const char* task) {
    return {fmt::format("/tasks/{}/milliseconds", task), 1, false, kChunksInView};
}

Value perChunk(const char* owner) {
    return {fmt::format("/bytes/{}", owner), 1e-3, false, kChunksInView};
}

}  // namespace

Table goalTable(const BenchSettings& s) {
    const Cell generated = generatingCell("landscape", s.viewDistance),
               loaded = loadingCell("landscape", s.viewDistance);
    const Cell oneThread{
        {"generate", "--radius", s.isQuick ? "6" : "16", "--threads", "1", "--backend", "cpu"}};
    const auto triangles = [&](const char* method) {
        return frameCell(s, "landscape", {{"--aggregation", method}, {"--occlusion-culling", "off"}});
    };
    const Cell flight = flightCell(s, false);
    const std::string distance = fmt::format("V={}", s.viewDistance);
    return {
        "goals",
        "Figures to reach on two cores without a graphics card",
        "Landscape, overworld with everything on; goals are for V=32 and a quiet machine. Beside them what "
        "the thesis has, with a graphics card.",
        "view distance, area, time of flight",
        {"what", "goal", "measured", "thesis"},
        {{textEntry("generating with one thread, chunks/s"), textEntry("≥ 1500"),
          valueEntry(oneThread, {"/chunks_per_second"}), textEntry("41–84")},
         {textEntry("light from scratch, both stages, ms a chunk"), textEntry("≤ 0.25"),
          sumEntry(generated, {taskPerChunk("own light"), taskPerChunk("light")}), textEntry("9.7")},
         {textEntry("mesh, ms a chunk"), textEntry("≤ 0.04"), valueEntry(generated, taskPerChunk("mesh")),
          textEntry("–")},
         {textEntry("from nothing to all in view, generating, s, " + distance), textEntry("≤ 6"),
          valueEntry(generated, loadSeconds()), textEntry("–")},
         {textEntry("the same from a save, s, " + distance), textEntry("≤ 4"),
          valueEntry(loaded, loadSeconds()), textEntry("41")},
         {textEntry("RAM, blocks and light, kB a chunk"), textEntry("≤ 44"),
          sumEntry(generated, {perChunk("blocks"), perChunk("light")}), textEntry("313")},
         {textEntry("GPU, quads and light, kB a chunk"), textEntry("≤ 42"),
          sumEntry(generated, {perChunk("quads_gpu"), perChunk("light_gpu")}), textEntry("259")},
         {textEntry("save, kB a chunk"), textEntry("≤ 2.5"),
          valueEntry(loaded, {"/bytes/save", 1e-3, false, "/chunks"}), textEntry("–")},
         {textEntry("opaque triangles, greedy, % of squares ext"), textEntry("≤ 90"),
          shareEntry(triangles("greedy"), triangles("squares-ext"), {"/triangles/opaque"}), textEntry("100")},
         {textEntry("flight while generating: frames over twice the median because of loading"),
          textEntry("0"), valueEntry(flight, {"/flight/of_these_by_loading"}), textEntry("–")},
         {textEntry("frames over twice the median, for whatever reason"), textEntry("–"),
          valueEntry(flight, {"/flight/frames_over_twice_the_median"}), textEntry("–")},
         {textEntry("what loading takes of a frame at most, ms of the processor"), textEntry("–"),
          valueEntry(flight, {"/flight/most_loading_ms"}), textEntry("–")},
         {textEntry("its slowest frame, ms"), textEntry("–"),
          valueEntry(flight, {"/flight/slowest_frame_ms"}), textEntry("600")},
         {textEntry("the median of its frames, ms"), textEntry("–"), valueEntry(flight, {"/flight/frame_ms"}),
          textEntry("–")}},
        {}};
}

}  // namespace terrane::app
