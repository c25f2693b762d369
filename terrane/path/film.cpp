#include "terrane/path/film.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "terrane/base/digest.h"
#include "terrane/base/files.h"

namespace terrane::path {
namespace {

constexpr int kTile = 16;  // pixels along a side of what a job traces

void add(PixelSums& sums, const PathSample& sample) {
    const glm::dvec3 radiance(sample.radiance);
    sums.radiance += radiance;
    sums.squares += radiance * radiance;
    sums.albedo += glm::dvec3(sample.albedo);
    sums.normal += glm::dvec3(sample.normal);
    if (sample.depth <= 0) return;
    sums.depth += double{sample.depth};
    ++sums.surfaces;
}

// A file: these words, then the sums of all pixels as they are in memory.
constexpr std::uint64_t kMagic = 0x314D'4C49'4650'5254;  // "TRPFILM1"
struct Header {
    std::uint64_t magic = kMagic, key = 0;
    std::int32_t width = 0, height = 0;
    std::uint32_t samples = 0, unused = 0;
};
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(PixelSums) == 14 * sizeof(double) && sizeof(Header) == 32);

}  // namespace

base::Result<void> addSamples(Film& film, std::uint32_t count, base::JobSystem& jobs,
                              const std::function<Tracer()>& makeTracer) {
    const glm::ivec2 tiles = (film.size + kTile - 1) / kTile;
    TERRANE_TRY(base::parallelFor(jobs, static_cast<std::size_t>(tiles.x * tiles.y), [&](std::size_t k) {
        Tracer tracer = makeTracer();
        const int tile = static_cast<int>(k);
        const glm::ivec2 low = glm::ivec2(tile % tiles.x, tile / tiles.x) * kTile;
        const glm::ivec2 end = glm::min(low + kTile, film.size);
        for (int y = low.y; y < end.y; ++y) {
            for (int x = low.x; x < end.x; ++x) {
                PixelSums& sums = film.pixels[static_cast<std::size_t>(y * film.size.x + x)];
                for (std::uint32_t n = 0; n < count; ++n) add(sums, tracer.trace({x, y}, film.samples + n));
            }
        }
    }));
    film.samples += count;
    return {};
}

Means meansOf(const Film& film) {
    Means means;
    means.size = film.size;
    const double samples = std::max(film.samples, 1u);
    for (const PixelSums& sums : film.pixels) {
        const glm::dvec3 mean = sums.radiance / samples;
        const glm::dvec3 variance = glm::max(sums.squares / samples - mean * mean, 0.0);
        means.radiance.emplace_back(mean);
        means.albedo.emplace_back(sums.albedo / samples);
        means.normal.emplace_back(sums.normal / samples);
        means.depth.push_back(sums.surfaces > 0 ? static_cast<float>(sums.depth / sums.surfaces) : 0);
        means.variance.push_back(
            static_cast<float>((variance.x + variance.y + variance.z) / std::max(samples - 1, 1.0)));
    }
    return means;
}

namespace {

// Adds plain values without padding.
class Key {
  public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        digest_.update(std::as_bytes(std::span(&value, 1)));
    }
    template <class T>
    void addAll(std::span<const T> values) {
        digest_.update(std::as_bytes(values));
    }
    std::uint64_t value() const { return base::hash64(digest_.hex()); }

  private:
    base::Digest digest_;
};

void addTile(Key& key, const SceneTile& tile) {
    key.add(tile.pos.x);
    key.add(tile.pos.y);
    key.add(tile.pos.level);
    const world::Chunk& chunk = *tile.chunk;
    for (int s = chunk.heights().firstSection(); s < chunk.heights().endSection(); ++s) {
        const world::Section& section = chunk.section(s);
        if (section.isUniform()) key.add(section.uniformValue());
        key.addAll(section.palette());
        key.addAll(section.words());
    }
    if (tile.tint) key.addAll(std::span<const world::PackedColor>(*tile.tint));
}

}  // namespace

std::uint64_t keyOf(const Scene& scene, const Camera& camera, const TraceOptions& options) {
    Key key;
    for (const SceneTile& tile : scene.parts.tiles) addTile(key, tile);
    for (const Texture& texture : scene.parts.textures)
        key.addAll(std::span<const std::uint8_t>(texture.rgba));
    const Sky& sky = scene.parts.sky;
    key.add(sky.table.radiance);
    key.add(std::array{sky.lightShare, sky.toLight, sky.aureole, sky.discColor, sky.discRadiance});
    key.add(scene.parts.air.frame);
    key.add(std::array{sky.discCosine, scene.parts.air.fogDistance, scene.parts.air.cameraZ});
    key.add(camera.position);
    key.add(std::array{camera.ahead, camera.across, camera.up});
    key.add(std::array{camera.lensRadius, camera.focus, camera.isInWater ? 1.0f : 0.0f});
    key.add(options.size);
    key.add(options.seed);
    key.add(options.bounces);
    return key.value();
}

base::Result<void> saveFilm(const std::filesystem::path& path, const Film& film, std::uint64_t key) {
    Header header;
    header.key = key;
    header.width = film.size.x;
    header.height = film.size.y;
    header.samples = film.samples;
    std::string bytes(sizeof header + film.pixels.size() * sizeof(PixelSums), '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, film.pixels.data(), film.pixels.size() * sizeof(PixelSums));
    return base::writeFile(path, bytes);
}

base::Result<Film> loadFilm(const std::filesystem::path& path, glm::ivec2 size, std::uint64_t key) {
    Film film(size);
    const std::size_t expected = sizeof(Header) + film.pixels.size() * sizeof(PixelSums);
    const std::string bytes = TERRANE_TRY(base::readFile(path, expected));
    Header header;
    if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
    if (bytes.size() < sizeof header || header.magic != kMagic)
        return base::fail(base::ErrorCode::Damaged, "{}: is no file of samples of terrane render",
                          path.string());
    if (header.width != size.x || header.height != size.y || header.key != key)
        return base::fail(base::ErrorCode::Incompatible,
                          "{}: its samples are of another image: use the same options, or another file",
                          path.string());
    if (bytes.size() != expected)
        return base::fail(base::ErrorCode::Damaged, "{}: has {} bytes in place of {}", path.string(),
                          bytes.size(), expected);
    film.samples = header.samples;
    std::memcpy(film.pixels.data(), bytes.data() + sizeof header, film.pixels.size() * sizeof(PixelSums));
    return film;
}

}  // namespace terrane::path
