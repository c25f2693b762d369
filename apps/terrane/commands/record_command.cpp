// terrane record: renders a video along a camera path, without a window.
#include <chrono>
#include <cmath>
#include <memory>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/offscreen.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "apps/terrane/record/script.h"
#include "apps/terrane/record/title_painter.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/io/open_session.h"
#include "terrane/video/frame_sink.h"
#include "terrane/view/recorder.h"

namespace terrane::app {
namespace {

struct RecordOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    std::string path, output, framesFolder;
    int framesPerSecond = 30;
    double from = 0;
    std::optional<double> until;
};

// Frame k is at k / framesPerSecond seconds.
struct FrameRange {
    std::int64_t first = 0, end = 0;
};

base::Result<Script> readScript(const RecordOptions& options, const CLI::App& command) {
    auto text = TERRANE_TRY(base::readFile(options.path));
    const auto content = TERRANE_TRY(io::loadContent(options.world, options.save));
    ScriptDefaults defaults{options.world, options.graphics, {}};
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0) defaults.given.push_back(option->get_single_name());
    return parseScript(text, options.path, defaults, *content.blocks);
}

base::Result<FrameRange> framesOf(const RecordOptions& options, const Script& script) {
    const double until = std::min(options.until.value_or(script.seconds()), script.seconds());
    const auto frameAt = [&](double seconds) { return std::llround(seconds * options.framesPerSecond); };
    const FrameRange range{frameAt(options.from), frameAt(until)};
    if (range.first < range.end) return range;
    return base::fail("{}: no frame between {} and {} seconds; it has {}", options.path, options.from, until,
                      script.seconds());
}

base::Result<std::unique_ptr<video::FrameSink>> openSink(const RecordOptions& options) {
    if (!options.framesFolder.empty()) return video::openFrameFolder(options.framesFolder);
    return video::openVideo(options.output, {options.graphics.size, options.framesPerSecond});
}

base::Result<void> drawFrames(view::Recorder& recorder, video::FrameSink& sink, const FrameRange& range,
                              int framesPerSecond, const base::StopSignals& signals) {
    base::ProgressBar bar("recording", static_cast<std::size_t>(range.end - range.first));
    for (std::int64_t k = range.first; k < range.end; ++k) {
        auto image = TERRANE_TRY(recorder.frame(static_cast<double>(k) / framesPerSecond));
        TERRANE_TRY(sink.add(image));
        bar.set(static_cast<std::size_t>(k + 1 - range.first));
        if (signals.stopRequested())
            return base::fail("stopped after {} of {} frames", k + 1 - range.first, range.end - range.first);
    }
    return {};
}

base::Result<void> recordVideo(const RecordOptions& options, const CLI::App& command) {
    if (options.output.empty() && options.framesFolder.empty())
        return base::fail("record needs --output or --frames-dir");
    auto script = TERRANE_TRY(readScript(options, command));
    const auto range = TERRANE_TRY(framesOf(options, script));
    const TitlePainter titles(options.graphics.size.y);

    // Edits of the path are not saved: the world is opened read-only.
    const view::OptionsCue& first = view::optionsAt(view::shotAt(script.shots, options.from), 0);
    GraphicsOptions graphics = options.graphics;
    graphics.choices = first.choices;
    graphics.view = first.view;
    auto world = TERRANE_TRY(openOffscreen(
        {.world = script.world, .save = options.save, .graphics = graphics, .backend = options.backend}));
    const base::StopSignals signals;  // until the file is finished; the sink removes an unfinished one
    auto sink = TERRANE_TRY(openSink(options));

    const auto start = std::chrono::steady_clock::now();
    view::Recorder recorder({script.shots, *world, options.graphics.size,
                             [&](base::Image& image, const view::TitleCue& title, float strength) {
                                 titles.paint(image, title.text, title.isLarge, strength);
                             }});
    TERRANE_TRY(drawFrames(recorder, *sink, range, options.framesPerSecond, signals));
    TERRANE_TRY(world->finish());
    TERRANE_TRY(sink->finish());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::int64_t frames = range.end - range.first;
    base::logInfo("{}: {} frames, {:.1f} s of video in {:.1f} s",
                  options.output.empty() ? options.framesFolder : options.output, frames,
                  static_cast<double>(frames) / options.framesPerSecond, seconds);
    return {};
}

}  // namespace

CommandEntry addRecord(CLI::App& app) {
    auto options = std::make_shared<RecordOptions>();
    CLI::App* command = app.add_subcommand("record", "Make a video along a camera path, without a window");
    command->add_option("--path", options->path, "The path: keys, titles, edits (TOML, see docs/video.md)")
        ->type_name("FILE")
        ->required();
    addOutputOption(*command, options->output, {".mp4", ".mkv"}, "The video, .mp4 or .mkv; made by ffmpeg");
    command->get_option("--output")->required(false);
    writesFolder(command->add_option("--frames-dir", options->framesFolder,
                                     "Write frames as PNG files into this folder instead"))
        ->excludes("--output");
    command->add_option("--fps", options->framesPerSecond, "Frames per second")
        ->check(numberFrom(1, 240))
        ->capture_default_str();
    command->add_option("--from", options->from, "Start at this second of the path")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    command->add_option("--until", options->until, "End at this second of the path")
        ->check(numberFrom(0, 1e6));
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save,
                   "World to record, which stays unchanged; missing chunks are generated");
    addBackendOption(*command, options->backend, "Device that generates, lights and meshes");
    addGraphicsOptions(*command, options->graphics, "high");
    return {command, [options, command] { return recordVideo(*options, *command); }};
}

}  // namespace terrane::app
