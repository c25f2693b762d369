// Tables that the thesis does not have: stages, passes, memory, disk.
#include <fmt/format.h>

#include "apps/terrane/bench/bench_cells.h"

namespace terrane::app {
namespace {

constexpr double kBlockBytes = 2.0 * 65536;  // of a chunk, unpacked

// A stage of the way of a chunk: its time, and the bytes that it must read and write at least.
struct Stage {
    const char* name;
    Cell cell;
    Value microseconds;
    std::vector<Value> bytes;  // a chunk, from the measurement
    double moreBytes;
    const char* limit;
};

Value taskMicroseconds(const std::string& task) {
    return {fmt::format("/tasks/{}/milliseconds", task), 1000, false, fmt::format("/tasks/{}/count", task)};
}

// What the bytes of a stage take at the speed of copying, which reads and writes each byte; µs.
Entry floorEntry(const Stage& stage) {
    const auto compute = [bytes = stage.bytes, more = stage.moreBytes](
                             std::span<const nlohmann::json> m) -> std::optional<double> {
        double sum = more;
        for (const Value& value : bytes) sum += valueIn(m[0], value).value_or(0);
        const auto speed = valueIn(m[1], {"/bytes_per_second"});
        if (!speed || *speed <= 0) return std::nullopt;
        return 1e6 * sum / (2 * *speed);
    };
    return {"", {stage.cell, memoryCopyCell()}, compute};
}

std::vector<Stage> stagesOf(const BenchSettings& s) {
    const Cell generated = generatingCell("landscape", s.viewDistance);
    const Cell loaded = loadingCell("landscape", s.viewDistance);
    const Value blocks{"/bytes/blocks", 1, false, "/chunks"};
    const Value light{"/bytes/light", 1, false, kChunksInView};
    const Value lightGpu{"/bytes/light_gpu", 1, false, kChunksInView};
    const Value quads{"/bytes/quads_gpu", 1, false, kChunksInView};
    return {
        {"generate",
         generated,
         taskMicroseconds("load or generate"),
         {blocks},
         4 * kBlockBytes,
         "two voxel passes write all blocks, one reads them, packing reads them; the rest is arithmetic"},
        {"load from a save",
         loaded,
         taskMicroseconds("load or generate"),
         {blocks, {"/bytes/save", 1, false, "/chunks"}},
         0,
         "reading a row of SQLite, decompressing"},
        {"light, stage 1",
         loaded,
         taskMicroseconds("own light"),
         {blocks, light},
         0,
         "bricks that are not uniform: 5 to 6 a chunk, unpacked to a few bytes a block and searched"},
        {"light, stage 2",
         loaded,
         taskMicroseconds("light"),
         {light, light},
         0,
         "twelve borders to neighbours, rows that change, packing"},
        {"mesh",
         loaded,
         taskMicroseconds("mesh"),
         {blocks, quads},
         0,
         "bit planes of sections, 16 ns for each quad"},
        {"upload",
         loaded,
         {"/milliseconds/upload", 1000, false, kChunksInView},
         {quads, quads, lightGpu, lightGpu},
         0,
         "the driver's copies"},
    };
}

Table stages(const BenchSettings& s) {
    Table table{
        "stages",
        "Stages of a chunk",
        fmt::format(
            "Landscape, V={}: time of a worker (upload: of the main thread) for a chunk. Beside it what "
            "reading and writing the stage's bytes takes at the speed at which one thread copies memory "
            "here: no program can be faster, and how far from it a stage is says how much of it is not "
            "memory.",
            s.viewDistance),
        "view distance",
        {"stage", "µs a chunk", "memory alone, µs", "what takes the time"},
        {},
        {}};
    for (const Stage& stage : stagesOf(s)) {
        table.rows.push_back({textEntry(stage.name), valueEntry(stage.cell, stage.microseconds),
                              floorEntry(stage), textEntry(stage.limit)});
    }
    table.rows.push_back({textEntry("memory copied by one thread, GB/s"),
                          valueEntry(memoryCopyCell(), {"/bytes_per_second", 1e-9}), textEntry("–"),
                          textEntry("")});
    return table;
}

constexpr std::array kPasses = {
    "cull",  "shadow map", "surfaces",     "depth pyramid", "cull again",     "surfaces again", "sky",
    "shade", "peel",       "shade layers", "god rays",      "depth of field", "final"};

Table passes(const BenchSettings& s) {
    Table table{
        "passes",
        "Passes of the frame",
        fmt::format("GPU milliseconds of each pass, {}, V={}; the last column is nanoseconds a pixel of the "
                    "picture (the software renderer draws 4 samples each). A pass that does not run has no "
                    "time.",
                    s.size, s.viewDistance),
        "view distance, size",
        {"pass"},
        {},
        {{"", PlotKind::Bars, "pass", "milliseconds", {1, 2, 3, 4}, 1}}};
    for (const char* scene : kSceneNames) table.columns.push_back(fmt::format("{}, ms", scene));
    table.columns.push_back("landscape, ns a pixel");
    for (const char* pass : kPasses) {
        std::vector<Entry> row{textEntry(pass)};
        const std::string pointer = fmt::format("/passes/{}", pass);
        for (const char* scene : kSceneNames) row.push_back(valueEntry(frameCell(s, scene), {pointer}));
        row.push_back(valueEntry(frameCell(s, "landscape"), {pointer, 1e6 / pixelsOf(s.size)}));
        table.rows.push_back(std::move(row));
    }
    std::vector<Entry> all{textEntry("the frame")};
    for (const char* scene : kSceneNames)
        all.push_back(valueEntry(frameCell(s, scene), {"/milliseconds/frame"}));
    all.push_back(valueEntry(frameCell(s, "landscape"), {"/milliseconds/frame", 1e6 / pixelsOf(s.size)}));
    table.rows.push_back(std::move(all));
    return table;
}

Table memoryByOwner(const BenchSettings& s) {
    const std::vector<std::pair<const char*, const char*>> owners = {
        {"blocks", "blocks"},
        {"light", "light"},
        {"light of stage 1, until neighbours are lit", "light_of_stage_1"},
        {"fields of the generator", "generator_cache"},
        {"quads on the GPU", "quads_gpu"},
        {"light on the GPU", "light_gpu"},
        {"the process", "process"},
        {"the process at its peak", "process_peak"}};
    Table table{"memory-by-owner",
                "Memory by owner",
                "Landscape, MB; the last column is of the largest view distance, for each chunk in view. The "
                "process has the GPU's memory, too, where the processor draws.",
                "smaller view distances",
                {"owner"},
                {},
                {}};
    for (const int distance : viewDistances(s)) table.columns.push_back(fmt::format("V={}", distance));
    table.columns.push_back("kB a chunk");
    for (const auto& [name, key] : owners) {
        std::vector<Entry> row{textEntry(name)};
        const std::string pointer = fmt::format("/bytes/{}", key);
        for (const int distance : viewDistances(s))
            row.push_back(valueEntry(generatingCell("landscape", distance), {pointer, 1e-6}));
        row.push_back(
            valueEntry(generatingCell("landscape", s.viewDistance), {pointer, 1e-3, false, kChunksInView}));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table disk(const BenchSettings& s) {
    Table table{"disk",
                "Saves",
                "A save that has everything in view of a scene.",
                "view distance",
                {"scene", "chunks", "file, MB", "bytes a chunk", "load all in view, s"},
                {},
                {}};
    for (const char* scene : kSceneNames) {
        const Cell cell = loadingCell(scene, s.viewDistance);
        table.rows.push_back(
            {textEntry(scene), valueEntry(cell, {"/chunks"}), valueEntry(cell, {"/bytes/save", 1e-6}),
             valueEntry(cell, {"/bytes/save", 1, false, "/chunks"}), valueEntry(cell, loadSeconds())});
    }
    return table;
}

}  // namespace

std::vector<Table> ownTables(const BenchSettings& s) {
    return {stages(s), passes(s), memoryByOwner(s), disk(s)};
}

}  // namespace terrane::app
