// Traces one light path from the camera through a pixel: the estimator of the path tracer (docs/rays.md). A
// Tracer has the memory of one thread; its results depend on pixel, sample and seed alone.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

#include "terrane/path/random.h"
#include "terrane/path/scene.h"

namespace terrane::path {

// A thin lens, in blocks in the world. Rays through the middle of the lens go toward ahead + x · across +
// y · up, with x and y from -1 to 1.
struct Camera {
    glm::dvec3 position{0};
    glm::vec3 ahead{1, 0, 0}, across{0, -1, 0}, up{0, 0, 1};  // ahead: length 1
    float lensRadius = 0;                                     // 0: all is sharp
    float focus = 16;                                         // distance along `ahead` that is sharp
    bool isInWater = false;
};

struct TraceOptions {
    glm::ivec2 size{1, 1};  // pixels of the image
    std::uint32_t seed = 0;
    int bounces = 64;  // after so many the path ends; roulette ends nearly all before
};

// What one path has found. Albedo, normal and depth are of the first surface that scatters light.
struct PathSample {
    glm::vec3 radiance{0};
    glm::vec3 albedo{0};
    glm::vec3 normal{0};
    float depth = 0;  // blocks from the camera along `ahead`; 0: the sky
};

// Where a ray begins: in a block, at a place in it from 0 to 1. `face`, if not null, is not met again.
struct Start {
    glm::ivec3 cell{0};
    glm::vec3 inCell{0};
    bool isInWater = false;
    bool isOnFace = false;
    world::ChunkPos tile;
    world::BlockIndex block = 0;
    std::uint16_t shapeFace = 0;
};

class Tracer {
  public:
    // Both outlive this.
    Tracer(const Scene& scene, const Camera& camera, const TraceOptions& options);

    // `pixel`: from the upper left corner.
    PathSample trace(glm::ivec2 pixel, std::uint32_t sample);

    // Share of light that comes along a straight line: from far away, or from the face `target`.
    glm::vec3 transmitted(const Start& start, glm::vec3 direction, float end, const Emitter* target);

  private:
    // Where light is scattered.
    struct Vertex {
        enum class Kind : std::uint8_t {
            Diffuse,  // to the side of the normal
            Thin,     // plants: to both sides
            Volume,   // water: to all sides
        };
        Kind kind = Kind::Diffuse;
        glm::dvec3 position{0};
        glm::vec3 normal{0};
        glm::vec3 albedo{0};
        Start start;
    };
    enum class End : std::uint8_t { Sky, Surface, Mirror, Volume, Nothing };
    // The way of a ray up to its end.
    struct Way {
        End end = End::Sky;
        glm::vec3 through{1};  // share of light that passes, over the chance of the way
        float length = 0;
        glm::vec3 mirror{0};             // normal of a mirror, with waves
        glm::vec3 emitted{0}, shown{0};  // by a surface, for others and for a camera
        const Emitter* emitter = nullptr;
        Vertex vertex;
    };

    Start cameraRay(glm::ivec2 pixel, Random& random, glm::vec3& direction) const;
    Way follow(const Start& start, glm::vec3 direction, Random& random);
    glm::vec3 lightFromDisc(const Vertex& vertex, Random& random);
    glm::vec3 lightFromSky(const Vertex& vertex, Random& random);
    glm::vec3 lightFromEmitters(const Vertex& vertex, Random& random);
    float density(const Vertex& vertex, glm::vec3 direction) const;
    glm::vec3 scatter(const Vertex& vertex, Random& random) const;
    void passAir(const Way& way, glm::vec3 direction, bool isFirst, glm::vec3& through,
                 glm::vec3& light) const;

    const Scene& scene_;
    const Camera& camera_;
    const TraceOptions& options_;
    rays::SurfaceWalk walk_;
};

// Share of the sky, by the cosine, that level ground at a point would see.
float openSky(const Scene& scene, const glm::dvec3& point);

}  // namespace terrane::path
