#include "terrane/path/tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "terrane/mesh/shape_faces.h"

namespace terrane::path {
namespace {

using rays::Surface;
using world::AlphaMode, world::Shape;

constexpr float kFarthest = 4e6f;  // blocks: a ray reaches 2^23

// Refractive indices of water and glass.
constexpr float kWaterIndex = 1.333f, kGlassIndex = 1.5f;
// Water loses so much light a block (water_body.glsl); a share of it is scattered to all sides, so that deep
// water is blue.
constexpr glm::vec3 kWaterLoss{0.34f, 0.19f, 0.165f}, kWaterScattered{0.06f, 0.38f, 0.62f};
constexpr float kWaterMeanLoss = 0.2f;  // for the place of scattering
// Of the part of glass that its texture covers, so much of the light is scattered, the rest takes the
// texture's color and passes.
constexpr float kGlassScattered = 0.25f;
constexpr float kLeastRoulette = 0.05f;

// Reflectance of a smooth surface for light that comes from the thinner side (A.-J. Fresnel). Water has the
// same from below: light crosses it straight.
float fresnel(float cosine, float index) {
    cosine = std::min(std::abs(cosine), 1.0f);
    const float inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
    const float s = (cosine - index * inside) / (cosine + index * inside);
    const float p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5f * (s * s + p * p);
}
// Of a pane, between whose two sides light goes to and fro.
float paneReflectance(float cosine) {
    const float once = fresnel(cosine, kGlassIndex);
    return 2 * once / (1 + once);
}

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

shared::Ray rayOf(const Start& start, glm::vec3 direction, float end = kFarthest) {
    return shared::makeRay(glm::ivec4(start.cell, 0), glm::vec4(start.inCell, 0), glm::vec4(direction, 0),
                           end);
}

bool isStartOf(const Start& start, const Surface& surface) {
    return start.isOnFace && start.shapeFace == surface.face.shapeFace && start.block == surface.block &&
           start.tile == surface.tile;
}

Start startAt(const glm::dvec3& point) {
    const glm::dvec3 cell = glm::floor(point);
    Start start;
    start.cell = glm::ivec3(cell);
    start.inCell = glm::vec3(point - cell);
    return start;
}

// On a surface, on the side that `normal` points to.
Start startOn(const Start& from, const Surface& surface, glm::vec3 direction, glm::vec3 normal) {
    const int level = surface.tile.level, width = 1 << level;
    const glm::ivec3 low((surface.tile.x * 16 + (surface.block & 15)) * width,
                         (surface.tile.y * 16 + (surface.block >> 4 & 15)) * width, surface.block >> 8);
    const glm::ivec3 high = low + glm::ivec3(width - 1, width - 1, 0);
    const glm::dvec3 at =
        glm::dvec3(from.inCell) + glm::dvec3(direction) * double{surface.t};  // from the cell of the start
    const glm::dvec3 floor = glm::floor(at);
    Start start;
    start.isInWater = from.isInWater;
    start.isOnFace = true;
    start.tile = surface.tile;
    start.block = surface.block;
    start.shapeFace = surface.face.shapeFace;
    start.cell = glm::clamp(from.cell + glm::ivec3(floor), low, high);
    for (int axis = 0; axis < 3; ++axis) {
        const double in = at[axis] - static_cast<double>(start.cell[axis] - from.cell[axis]);
        start.inCell[axis] = static_cast<float>(std::clamp(in, 0.0, 1.0));
    }
    if (surface.face.shapeFace >= shared::kShapeFaceCross) return start;
    // A side of the cell: exactly on its plane, in the cell on the side of the normal.
    const int axis = surface.face.shapeFace / 2,
              plane = surface.face.shapeFace % 2 == 1 ? high[axis] + 1 : low[axis];
    const bool isAbove = normal[axis] > 0;
    start.cell[axis] = isAbove ? plane : plane - 1;
    start.inCell[axis] = isAbove ? 0.0f : 1.0f;
    return start;
}

glm::dvec3 positionOf(const Start& start) {
    return glm::dvec3(start.cell) + glm::dvec3(start.inCell);
}

glm::vec3 onDisc(glm::vec2 random) {
    const float radius = std::sqrt(random.x), angle = 2 * kPi * random.y;
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

float smoothstep(float low, float high, float v) {
    const float t = glm::clamp((v - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

// Optical depth, in powers of ½: airDepth() of distance_fog.glsl.
glm::vec3 airDepth(const Air& air, glm::vec3 toPoint, float blocks, float share2) {
    constexpr float kLog2E = 1.442695f;
    const float camera = air.cameraZ - air.frame.levels.x;
    const float below = std::max(-camera - toPoint.z, 0.0f) - std::max(-camera, 0.0f);
    const float shareBelow =
        std::abs(toPoint.z) < 1e-3f ? static_cast<float>(camera < 0) : -below / toPoint.z;
    float rise = std::max((toPoint.z + below) * air.frame.depth.z, -80.0f);
    if (std::abs(rise) < 1e-3f) rise = 1e-3f;
    const float haze = glm::mix(air.frame.depth.y * ((1 - std::exp2(-kLog2E * rise)) / rise),
                                air.frame.lightAzimuth.w, shareBelow);
    const float molecules = air.frame.depth.x * glm::clamp(1 - toPoint.z * air.frame.depth.w, 0.3f, 1.7f);
    return (molecules * glm::vec3(1, 2, 5) + haze) * blocks + 1.7f * share2 * share2;
}

// Slopes of waves on water, as sums of sines along whole numbers of periods in 64 blocks.
glm::vec3 waveNormal(const glm::dvec3& at) {
    struct Wave {
        glm::dvec2 perBlocks;  // periods in 64 blocks
        double slope;
    };
    constexpr Wave kWaves[] = {
        {{5, 3}, 0.018}, {{-4, 9}, 0.016}, {{11, -6}, 0.012}, {{17, 14}, 0.010}, {{-27, 21}, 0.008}};
    glm::dvec2 slope(0);
    for (const Wave& wave : kWaves) {
        const double phase = 2 * std::numbers::pi / 64 * (wave.perBlocks.x * at.x + wave.perBlocks.y * at.y);
        slope += wave.perBlocks / glm::length(wave.perBlocks) * (wave.slope * std::cos(phase));
    }
    return glm::normalize(glm::vec3(-slope.x, -slope.y, 1));
}

}  // namespace

Tracer::Tracer(const Scene& scene, const Camera& camera, const TraceOptions& options)
    : scene_(scene), camera_(camera), options_(options) {}

Start Tracer::cameraRay(glm::ivec2 pixel, Random& random, glm::vec3& direction) const {
    const glm::vec2 at = (glm::vec2(pixel) + random.next2()) / glm::vec2(options_.size);
    direction = camera_.ahead + (2 * at.x - 1) * camera_.across + (1 - 2 * at.y) * camera_.up;
    const glm::vec3 lens = onDisc(random.next2()) * camera_.lensRadius;
    const glm::vec3 moved = lens.x * glm::normalize(camera_.across) + lens.y * glm::normalize(camera_.up);
    const glm::dvec3 from = camera_.position + glm::dvec3(moved);
    direction = glm::normalize(direction * camera_.focus - moved);
    Start start = startAt(from);
    start.isInWater = camera_.isInWater;
    return start;
}

// Goes through holes, water and glass by chance, to the next place that scatters or mirrors light.
Tracer::Way Tracer::follow(const Start& start, glm::vec3 direction, Random& random) {
    Way way;
    bool isInWater = start.isInWater;
    float before = 0;
    // In water a ray may be scattered before it reaches `t`.
    const auto passWater = [&](float t) {
        if (!isInWater) return true;
        const float length = t - before;
        const float free = -std::log(1 - random.next()) / kWaterMeanLoss;
        if (free >= length) {
            way.through *= glm::exp((kWaterMeanLoss - kWaterLoss) * length);
            return true;
        }
        way.through *= kWaterLoss * glm::exp((kWaterMeanLoss - kWaterLoss) * free) / kWaterMeanLoss;
        way.end = End::Volume;
        way.length = before + free;
        const glm::dvec3 at = positionOf(start) + glm::dvec3(direction) * double{way.length};
        way.vertex = {Vertex::Kind::Volume, at, -direction, kWaterScattered, startAt(at)};
        way.vertex.start.isInWater = true;
        return false;
    };
    const auto stop = [&](End end, const Surface& surface, glm::vec3 normal) {
        way.end = end;
        way.length = surface.t;
        way.vertex.start = startOn(start, surface, direction, normal);
        way.vertex.start.isInWater = isInWater;
        way.vertex.normal = normal;
        way.vertex.position = positionOf(way.vertex.start);
    };
    rays::forEachSurface(scene_.surfaces, rayOf(start, direction), walk_, [&](const Surface& surface) {
        if (isStartOf(start, surface)) return false;
        const Texel texel = texelOf(scene_, surface);
        if (texel.isHole) return false;
        if (!passWater(surface.t)) return true;
        before = surface.t;
        const shared::ShapeFace& shape = scene_.surfaces.shapeFaces[surface.face.shapeFace];
        glm::vec3 normal = mesh::normalOf(shape) * (surface.isFront ? 1.0f : -1.0f);
        const world::Material& material = scene_.parts.blocks->materials()[surface.face.material];
        if (material.alpha == AlphaMode::Blend) {
            const bool isLiquid = blockOf(scene_, surface).shape == Shape::Liquid;
            glm::vec3 mirror = normal;
            if (isLiquid && std::abs(normal.z) > 0.9f) {
                mirror = waveNormal(positionOf(start) + glm::dvec3(direction) * double{surface.t}) * normal.z;
                if (glm::dot(mirror, direction) > -0.02f) mirror = normal;
            }
            const float cosine = glm::dot(mirror, direction);
            if (random.next() < (isLiquid ? fresnel(cosine, kWaterIndex) : paneReflectance(cosine))) {
                stop(End::Mirror, surface, normal);
                way.mirror = mirror;
                return true;
            }
            if (isLiquid) {
                isInWater = surface.isFront;
                return false;
            }
            const float scattered = kGlassScattered * texel.alpha;
            if (random.next() >= scattered) {
                way.through *=
                    ((1 - texel.alpha) + (1 - kGlassScattered) * texel.alpha * texel.color) / (1 - scattered);
                return false;
            }
        }
        stop(End::Surface, surface, normal);
        way.vertex.kind = shared::faceDirectionOf(shape) >= shared::kDirectionPlant ? Vertex::Kind::Thin
                                                                                    : Vertex::Kind::Diffuse;
        way.vertex.albedo = texel.color;
        way.shown = texel.color * texel.glow;
        way.emitted = emittedBy(scene_, surface, texel);
        if (way.emitted != glm::vec3(0))
            way.emitter = scene_.emitters.find(surface.tile, surface.block, surface.face.shapeFace);
        return true;
    });
    if (walk_.isEnclosed) {
        way.end = End::Nothing;
    } else if (way.end == End::Sky) {
        const float height = static_cast<float>(scene_.parts.heights.top - start.cell.z);
        passWater(isInWater ? std::max(height, 0.0f) / std::max(direction.z, 1e-3f) + before : before);
    }
    return way;
}

glm::vec3 Tracer::transmitted(const Start& start, glm::vec3 direction, float end, const Emitter* target) {
    glm::vec3 left(1);
    bool isInWater = start.isInWater, isReached = target == nullptr;
    float before = 0;
    rays::forEachSurface(scene_.surfaces, rayOf(start, direction, end), walk_, [&](const Surface& surface) {
        if (isStartOf(start, surface)) return false;
        if (isInWater) left *= glm::exp(-kWaterLoss * (surface.t - before));
        before = surface.t;
        if (target != nullptr && surface.block == target->block &&
            surface.face.shapeFace == target->shapeFace && surface.tile == target->tile) {
            isReached = true;
            left *= emittedBy(scene_, surface, texelOf(scene_, surface));
            return true;
        }
        const Texel texel = texelOf(scene_, surface);
        if (texel.isHole) return false;
        if (scene_.parts.blocks->materials()[surface.face.material].alpha != AlphaMode::Blend) {
            left = glm::vec3(0);
            return true;
        }
        const shared::ShapeFace& shape = scene_.surfaces.shapeFaces[surface.face.shapeFace];
        const float cosine = glm::dot(mesh::normalOf(shape), direction);
        if (blockOf(scene_, surface).shape == Shape::Liquid) {
            left *= 1 - fresnel(cosine, kWaterIndex);
            isInWater = surface.isFront;
        } else {
            left *= (1 - paneReflectance(cosine)) *
                    ((1 - texel.alpha) + (1 - kGlassScattered) * texel.alpha * texel.color);
        }
        return largest(left) < 1e-4f;
    });
    return isReached && !walk_.isEnclosed ? left : glm::vec3(0);
}

// Share of scattered light that goes in a direction, per steradian: the integral over all is 1.
float Tracer::density(const Vertex& vertex, glm::vec3 direction) const {
    const float cosine = glm::dot(vertex.normal, direction);
    switch (vertex.kind) {
        case Vertex::Kind::Diffuse:
            return std::max(cosine, 0.0f) / kPi;
        case Vertex::Kind::Thin:
            return 0.5f * std::abs(cosine) / kPi;
        case Vertex::Kind::Volume:
            break;
    }
    return 0.25f / kPi;
}

// A direction with that density.
glm::vec3 Tracer::scatter(const Vertex& vertex, Random& random) const {
    const float choice = random.next();
    const glm::vec2 at = random.next2();
    if (vertex.kind == Vertex::Kind::Volume) {
        const float z = 1 - 2 * at.x, level = std::sqrt(std::max(1 - z * z, 0.0f)), angle = 2 * kPi * at.y;
        return {level * std::cos(angle), level * std::sin(angle), z};
    }
    const glm::vec3 disc = onDisc(at);
    const float up = std::sqrt(std::max(1 - at.x, 0.0f));
    // Half of the light that plants scatter goes through them.
    const bool isBehind = vertex.kind == Vertex::Kind::Thin && choice < 0.5f;
    const Frame frame = frameOf(vertex.normal);
    return glm::normalize(disc.x * frame.across + disc.y * frame.along +
                          (isBehind ? -up : up) * vertex.normal);
}

glm::vec3 Tracer::lightFromDisc(const Vertex& vertex, Random& random) {
    const Sky& sky = scene_.parts.sky;
    if (sky.discRadiance == glm::vec3(0)) return glm::vec3(0);
    const glm::vec3 direction = sampleDisc(sky, random.next2());
    const float share = density(vertex, direction);
    if (share == 0) return glm::vec3(0);
    return share * discSolidAngle(sky) * sky.discRadiance *
           transmitted(vertex.start, direction, kFarthest, nullptr);
}

// Light rays to the sky and to emitters, and scattered rays that end there, share their light by their
// densities (E. Veach, L. Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering, 1995).
glm::vec3 Tracer::lightFromSky(const Vertex& vertex, Random& random) {
    const Sky& sky = scene_.parts.sky;
    if (sky.cumulative.empty()) return glm::vec3(0);
    const glm::vec3 direction = sampleSky(sky, random.next2());
    const float share = density(vertex, direction);
    if (share == 0) return glm::vec3(0);
    return share / (skyDensity(sky, direction) + share) * skyLight(sky, direction) *
           transmitted(vertex.start, direction, kFarthest, nullptr);
}

glm::vec3 Tracer::lightFromEmitters(const Vertex& vertex, Random& random) {
    const auto choice = scene_.emitters.choose(vertex.position, random);
    const glm::vec2 at = random.next2();
    if (!choice) return glm::vec3(0);
    const Emitter& emitter = *choice->emitter;
    const glm::dvec3 target = emitter.corner + glm::dvec3(emitter.alongU * at.x + emitter.alongV * at.y);
    const glm::vec3 toTarget(target - vertex.position);
    const float distance2 = glm::dot(toTarget, toTarget);
    if (distance2 < 1e-8f) return glm::vec3(0);
    const glm::vec3 direction = toTarget / std::sqrt(distance2);
    const float facing = -glm::dot(emitter.normal, direction);
    const float share = density(vertex, direction);
    if (share == 0 || facing == 0 || (facing < 0 && !emitter.isTwoSided)) return glm::vec3(0);
    const float perLight = choice->chance * distance2 / (emitter.area * std::abs(facing));
    return share / (perLight + share) *
           transmitted(vertex.start, direction, 1.001f * std::sqrt(distance2) + 0.01f, &emitter);
}

// The air between the camera, or a mirror, and what is seen.
void Tracer::passAir(const Way& way, glm::vec3 direction, bool isFirst, glm::vec3& through,
                     glm::vec3& light) const {
    const Air& air = scene_.parts.air;
    if (air.fogDistance <= 0 || way.end == End::Sky) return;
    const glm::vec3 toPoint = direction * way.length, sky = seenSky(scene_.parts.sky, direction);
    const float share2 =
        (toPoint.x * toPoint.x + toPoint.y * toPoint.y) / (air.fogDistance * air.fogDistance);
    glm::vec3 left =
        glm::exp2(-airDepth(air, toPoint, way.length, share2) * smoothstep(-0.1f, 0.5f, air.daylight));
    if (isFirst) {
        const float border = std::max(std::abs(toPoint.x), std::abs(toPoint.y)) / air.fogDistance;
        left *= 1 - smoothstep(5.0f / 6, 1, std::max(border, 0.85f * std::sqrt(share2)));
    }
    light += through * (1.0f - left) * sky;
    through *= left;
}

PathSample Tracer::trace(glm::ivec2 pixel, std::uint32_t sample) {
    Random random{static_cast<std::uint32_t>(pixel.y * options_.size.x + pixel.x), sample, options_.seed};
    const Sky& sky = scene_.parts.sky;
    PathSample result;
    glm::vec3 direction, through(1);
    Start start = cameraRay(pixel, random, direction);
    bool isSeen = true, wasMirrored = false;  // the camera sees it, directly or in mirrors
    float before = 0;                         // distance along the camera's rays
    Vertex from;                              // where the ray was scattered
    float perScatter = 0;                     // density of its direction
    bool hadSkyRay = false;                   // from there
    for (int bounce = 0; bounce <= options_.bounces;) {
        Way way = follow(start, direction, random);
        if (isSeen && !start.isInWater) passAir(way, direction, !wasMirrored, through, result.radiance);
        through *= way.through;
        if (way.end == End::Sky) {
            glm::vec3 radiance = isSeen ? seenSky(sky, direction) : skyLight(sky, direction);
            if (hadSkyRay && !wasMirrored) radiance *= perScatter / (perScatter + skyDensity(sky, direction));
            // A mirror shows the disc as it lights; a camera as the rasterizer draws it.
            if (isSeen && direction.z > 0 && isInDisc(sky, direction))
                radiance = glm::max(radiance, wasMirrored ? sky.discRadiance : sky.discColor);
            result.radiance += through * radiance;
            break;
        }
        if (way.end == End::Mirror) {
            if (++bounce > options_.bounces) break;
            before += way.length;
            glm::vec3 mirrored = glm::reflect(direction, way.mirror);
            // Waves send no light through the surface.
            if (glm::dot(mirrored, way.vertex.normal) <= 0)
                mirrored = glm::reflect(direction, way.vertex.normal);
            direction = mirrored;
            start = way.vertex.start;
            wasMirrored = true;
            continue;
        }
        if (way.end == End::Nothing) break;
        const Vertex& vertex = way.vertex;
        if (way.end == End::Surface) {
            if (isSeen) {
                result.radiance += through * way.shown;
            } else if (way.emitter != nullptr && !wasMirrored) {
                const float facing = std::abs(glm::dot(way.emitter->normal, direction));
                const float perLight = scene_.emitters.chanceOf(*way.emitter, from.position) * way.length *
                                       way.length / (way.emitter->area * std::max(facing, 1e-6f));
                result.radiance += through * way.emitted * (perScatter / (perScatter + perLight));
            }
        }
        if (isSeen) {
            result.albedo = vertex.albedo;
            result.normal = vertex.normal;
            result.depth =
                wasMirrored ? before + way.length : way.length * glm::dot(direction, camera_.ahead);
        }
        through *= vertex.albedo;
        if (through == glm::vec3(0)) break;
        result.radiance += through * (lightFromDisc(vertex, random) + lightFromEmitters(vertex, random));
        // What is seen gets a light ray to the sky, too. Later it would cost more than it gains.
        hadSkyRay = isSeen;
        if (hadSkyRay) result.radiance += through * lightFromSky(vertex, random);
        const float chance = bounce == 0 ? 1.0f : glm::clamp(largest(through), kLeastRoulette, 1.0f);
        if (++bounce > options_.bounces || random.next() >= chance) break;
        from = vertex;
        direction = scatter(from, random);
        perScatter = density(from, direction);
        if (perScatter == 0) break;
        through /= chance;
        start = from.start;
        isSeen = wasMirrored = false;
    }
    return result;
}

float openSky(const Scene& scene, const glm::dvec3& point) {
    constexpr std::uint32_t kRays = 256;
    const Camera camera;
    const TraceOptions options;
    Tracer tracer(scene, camera, options);
    float sum = 0;
    for (std::uint32_t k = 0; k < kRays; ++k) {
        Random random{0, k, 0};
        const glm::vec2 at = random.next2();
        const glm::vec3 disc = onDisc(at);
        const glm::vec3 direction(disc.x, disc.y, std::sqrt(1 - at.x));
        sum += largest(tracer.transmitted(startAt(point), direction, kFarthest, nullptr));
    }
    return sum / kRays;
}

}  // namespace terrane::path
