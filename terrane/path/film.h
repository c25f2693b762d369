// The image of a path tracer while it gathers samples: sums of each pixel in double, so that runs can be
// resumed and give the same image to the bit. One thread owns a film; addSamples() uses many.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/base/result.h"
#include "terrane/path/tracer.h"

namespace terrane::path {

// Sums over the samples of a pixel.
struct PixelSums {
    glm::dvec3 radiance{0}, squares{0};  // squares: of radiance, for its variance
    glm::dvec3 albedo{0}, normal{0};
    double depth = 0, surfaces = 0;  // surfaces: samples that met one, which have a depth
};

struct Film {
    Film() = default;
    explicit Film(glm::ivec2 imageSize)
        : size(imageSize),
          pixels(static_cast<std::size_t>(imageSize.x) * static_cast<std::size_t>(imageSize.y)) {}

    glm::ivec2 size{0};
    std::uint32_t samples = 0;      // of each pixel
    std::vector<PixelSums> pixels;  // rows from the top
};

// Adds samples to all pixels, which are numbered on from those that the film has.
[[nodiscard]] base::Result<void> addSamples(Film& film, std::uint32_t count, base::JobSystem& jobs,
                                            const std::function<Tracer()>& makeTracer);

// Means over the samples. Buffers have a value for each pixel.
struct Means {
    glm::ivec2 size{0};
    std::vector<glm::vec3> radiance, albedo, normal;
    std::vector<float> depth;     // blocks; 0: no surface
    std::vector<float> variance;  // of the mean radiance, its three channels together
};
Means meansOf(const Film& film);

// What an image depends on, other than its samples: scene, camera and options.
std::uint64_t keyOf(const Scene& scene, const Camera& camera, const TraceOptions& options);

// A film in a file. `key` says what is drawn; a file with another key cannot be resumed.
[[nodiscard]] base::Result<void> saveFilm(const std::filesystem::path& path, const Film& film,
                                          std::uint64_t key);
[[nodiscard]] base::Result<Film> loadFilm(const std::filesystem::path& path, glm::ivec2 size,
                                          std::uint64_t key);

}  // namespace terrane::path
