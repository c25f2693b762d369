#include "terrane/path/film.h"

#include <cstring>
#include <filesystem>

#include "tests/path/path_world.h"

namespace terrane::path {
namespace {

// Steps under a sky with a sun, and a lamp.
struct SteppedImage {
    SteppedImage()
        : scene(pathParts(
              [](int x, int y, int z) {
                  if (x == 3 && y == 1 && z == 14) return "lamp";
                  return z < 8 + (x & 3) + (y & 7) ? "gray" : nullptr;
              },
              skyOf(world::environmentAt(0.7f), airOf(0.7f)))) {
        camera.position = {-6.5, 0.5, 20};
        camera.ahead = glm::vec3(0.8f, 0, -0.6f);
        camera.across = {0, -0.5f, 0};
        camera.up = glm::vec3(0.3f, 0, 0.4f);
        options.size = {24, 18};
    }
    static shared::AirFrame airOf(float time) {
        shared::AirFrame air{};
        air.lightAzimuth.z = world::environmentAt(time).ambientColor.y;
        return air;
    }
    void add(Film& film, std::uint32_t samples, unsigned threads) const {
        base::JobSystem jobs(threads);
        ASSERT_TRUE(addSamples(film, samples, jobs, [&] { return Tracer(scene, camera, options); }));
    }
    Film traced(std::uint32_t samples, unsigned threads = 2) const {
        Film film(options.size);
        add(film, samples, threads);
        return film;
    }

    Scene scene;
    Camera camera;
    TraceOptions options;
};

bool isEqual(const Film& a, const Film& b) {
    return a.samples == b.samples && a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(PixelSums)) == 0;
}

TEST(FilmTest, ThreadsDoNotMatter) {
    const SteppedImage image;
    EXPECT_TRUE(isEqual(image.traced(8, 1), image.traced(8, 3)));
}

TEST(FilmTest, AResumedImageIsTheSame) {
    const SteppedImage image;
    const auto path = std::filesystem::temp_directory_path() / "terrane_film_test.samples";
    const Film straight = image.traced(8);
    Film film = image.traced(3);
    ASSERT_TRUE(saveFilm(path, film, 5));
    Film resumed = loadFilm(path, image.options.size, 5).value();
    EXPECT_TRUE(isEqual(film, resumed));
    image.add(resumed, 5, 2);
    EXPECT_TRUE(isEqual(straight, resumed));

    EXPECT_EQ(loadFilm(path, image.options.size, 6).error().code, base::ErrorCode::Incompatible);
    EXPECT_EQ(loadFilm(path, {18, 24}, 5).error().code, base::ErrorCode::Incompatible);
    std::filesystem::resize_file(path, 100);
    EXPECT_EQ(loadFilm(path, image.options.size, 5).error().code, base::ErrorCode::Damaged);
    std::filesystem::resize_file(path, 10);
    EXPECT_EQ(loadFilm(path, image.options.size, 5).error().code, base::ErrorCode::Damaged);
    std::filesystem::remove(path);
}

// Root of the mean square of the difference, over all pixels.
double distance(const Film& a, const Film& b) {
    const Means x = meansOf(a), y = meansOf(b);
    double sum = 0;
    for (std::size_t k = 0; k < x.radiance.size(); ++k) {
        const glm::dvec3 d(x.radiance[k] - y.radiance[k]);
        sum += glm::dot(d, d);
    }
    return std::sqrt(sum / static_cast<double>(x.radiance.size()));
}

// 16 times the samples leave a quarter of the error, and the variance says how large it is.
TEST(FilmTest, TheErrorFallsWithTheRootOfTheSamples) {
    SteppedImage image;
    const Film truth = image.traced(4096);
    image.options.seed = 1;
    const Film few = image.traced(16), many = image.traced(256);
    const double coarse = distance(few, truth), fine = distance(many, truth);
    EXPECT_NEAR(coarse / fine, 4, 1);
    const Means means = meansOf(few);
    double variance = 0;
    for (const float v : means.variance) variance += double{v};
    EXPECT_NEAR(std::sqrt(variance / static_cast<double>(means.variance.size())) / coarse, 1, 0.15);
}

TEST(FilmTest, MeansHaveTheFirstSurface) {
    const SteppedImage image;
    Film film(image.options.size);
    image.add(film, 16, 2);
    const Means means = meansOf(film);
    const std::size_t middle = 12 + 9 * 24;
    EXPECT_NEAR(double{means.albedo[middle].y}, grayAlbedo(), 1e-5);
    EXPECT_GT(means.depth[middle], 5);
    EXPECT_LT(means.depth[middle], 30);
    EXPECT_LE(glm::length(means.normal[middle]), 1.0001f);
}

}  // namespace
}  // namespace terrane::path
