#include "tests/window/window_fixture.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "terrane/io/open_session.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::app {
namespace {

struct OpenSave {
    pack::Content content;
    std::unique_ptr<store::ChunkStore> store;
};

OpenSave openWorldOf(const std::filesystem::path& file, store::WorldAccess access) {
    io::WorldOptions options;
    if (access == store::WorldAccess::ReadWrite) options.generator = "flat";
    const io::SaveOptions save{.world = file.string(), .storeGenerated = {}};
    auto content = io::loadContent(options, save);
    auto store = io::openSave(options, save, access, content.value());
    return {*std::move(content), std::move(store.value())};
}

}  // namespace

void WindowTest::SetUp() {
    const auto context = gpu::HeadlessContext::create({});
    gpu::checkExpectedRenderer(context);
    if (!context) GTEST_SKIP() << "1 test skipped, no OpenGL: " << context.error().message;
    for (const char* variable : {"XDG_DATA_HOME", "XDG_CONFIG_HOME"}) setenv(variable, folder().c_str(), 1);
    before_ = std::filesystem::current_path();
    std::filesystem::current_path(folder());
    std::filesystem::create_directories(data());
    std::fflush(stderr);
    errorOutput_ = dup(STDERR_FILENO);
    const int file = open((folder() / "log.txt").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    dup2(file, STDERR_FILENO);
    close(file);
}

void WindowTest::TearDown() {
    if (errorOutput_ < 0) return;
    dup2(errorOutput_, STDERR_FILENO);
    close(errorOutput_);
    if (HasFailure()) std::fputs(log().c_str(), stderr);
    std::filesystem::current_path(before_);
}

Program WindowTest::start(std::vector<std::string> arguments) {
    const std::vector<std::string> usual = {"--debug-gl",
                                            "--preset",
                                            "low",
                                            "--view-distance",
                                            "2",
                                            "--horizon",
                                            "0",
                                            "--language",
                                            "en",
                                            "--threads",
                                            "1",
                                            "--reduced-motion",
                                            "--target-fps",
                                            "off"};
    const auto isGiven = [&](const std::string& name) { return std::ranges::count(arguments, name) > 0; };
    arguments.insert(arguments.begin(), usual.begin(), usual.end());
    if (!isGiven("--size")) arguments.insert(arguments.end(), {"--size", "480x300"});
    if (!showsHint_) arguments.emplace_back("--hint-seen");
    if (!isGiven("--sound-volume")) arguments.insert(arguments.end(), {"--sound-volume", "0"});
    return Program(arguments);
}

Program WindowTest::play(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--world", name, "--generator", "flat"});
    return start(std::move(arguments));
}

std::filesystem::path WindowTest::worldFile(const std::string& name) const {
    return data() / (name + ".sqlite");
}

void WindowTest::makeWorld(const std::string& name, const std::map<std::string, std::string>& metadata) {
    const OpenSave made = openWorldOf(worldFile(name), store::WorldAccess::ReadWrite);
    for (const auto& [key, value] : metadata) made.store->setMetadata(key, value);
    EXPECT_TRUE(made.store->flush());
}

std::vector<std::string> WindowTest::worldNames() const {
    std::vector<std::string> names;
    for (const auto& file : std::filesystem::directory_iterator(data()))
        if (file.path().extension() == ".sqlite") names.push_back(file.path().stem());
    std::ranges::sort(names);
    return names;
}

std::string WindowTest::setting(const std::string& name, const std::string& key) const {
    return openWorldOf(worldFile(name), store::WorldAccess::ReadOnly).store->metadata(key).value_or("");
}

std::string WindowTest::savedBlock(const std::string& name, world::BlockPos pos) const {
    const OpenSave save = openWorldOf(worldFile(name), store::WorldAccess::ReadOnly);
    const store::LoadedChunk loaded = save.store->load(world::chunkOf(pos));
    if (!loaded.chunk) return "not saved";
    return save.content.blocks->type(loaded.chunk->block(world::blockIndex(pos.x & 15, pos.y & 15, pos.z)))
        .name;
}

std::vector<std::string> WindowTest::settingsLines() const {
    std::vector<std::string> lines = linesOf(data() / "settings.toml");
    std::erase_if(lines, [](const std::string& line) { return line.empty() || line[0] == '#'; });
    return lines;
}

std::string WindowTest::log() const {
    return textOf(folder() / "log.txt");
}

void WindowTest::expectGood(const base::Result<void>& result) const {
    EXPECT_TRUE(result) << result.error().message;
    EXPECT_EQ(log().find("error"), std::string::npos) << log();
    EXPECT_EQ(log().find("warning"), std::string::npos) << log();
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> linesOf(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

}  // namespace terrane::app
