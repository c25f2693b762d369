// Compares images with rays cast through the blocks of the chunks and tiles that they show: finds pixels
// where solid ground is not drawn. Used by bench_holes and the tests of tall worlds, on the thread of the
// OpenGL context.
#pragma once

#include <random>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/render/frame/renderer.h"

namespace terrane::bench {

constexpr double kNothing = 1e9;

// What the depth of a pixel may be, in blocks from the camera; kNothing if nothing is drawn there.
struct Interval {
    double low = kNothing, high = kNothing;
};

// Draws images of depth with these distances of fog, ascending: a pixel has a 255th of the first that reaches
// it. Pixels are by y from above, then x.
std::vector<Interval> drawnDistances(render::Renderer& renderer, const render::Camera& camera,
                                     std::span<const float> fogDistances);

// The rays through the pixels of a camera's image; whole numbers are centers of pixels. Their length is 1.
class PixelRays {
  public:
    PixelRays(const render::Camera& camera, glm::ivec2 size);
    glm::dvec3 at(double x, double y) const;

  private:
    glm::dvec3 look_, right_, up_;
    glm::dvec2 size_;
    double scale_;
};

// Where a ray ends, in blocks from the camera; kNothing if it meets no opaque cube.
struct RayEnd {
    double ground = 0;  // the first opaque cube of the generator
    double closed =
        0;  // the first block that is not made yet or closes a cave, or the ground if that is nearer
};

// The blocks on screen: of chunks and tiles that are shown, down to the bottom of the world, as they are
// saved or generated. Edits come before the first call.
class ShownBlocks {
  public:
    explicit ShownBlocks(game::Session& session) : session_(session) {}

    RayEnd cast(const glm::dvec3& origin, const glm::dvec3& direction, double mostBlocks);
    const world::Chunk& whole(world::ChunkPos pos);
    void forget() { whole_.clear(); }  // to free memory

  private:
    // A chunk or tile that is shown; no blocks where none is.
    struct Area {
        world::ChunkPos pos;
        const world::Chunk* whole = nullptr;
        int lowestMade = world::kLowestSection;
    };
    Area areaAt(int x, int y);
    double closedCave(const glm::dvec3& origin, const glm::dvec3& direction, double distance) const;

    game::Session& session_;
    std::unordered_map<world::ChunkPos, world::Chunk, world::ChunkPosHash> whole_;
};

// A camera in the air of a chunk of level 0: on the ground, in a cave, beside a cliff or high above. It looks
// anywhere.
render::Camera randomCamera(const world::Chunk& chunk, world::ChunkPos pos,
                            const world::BlockRegistry& blocks, std::mt19937& random);

// A pixel that does not agree with its ray. Distances in blocks.
struct Hole {
    glm::ivec2 pixel;
    double drawn = 0, ground = 0;
    glm::dvec3 groundAt;
};

// Pixels of an image. A pixel agrees with its ray if what is drawn is as far away as the ground, or as far as
// it is for one of the rays of the pixels around: edges lie between two rays.
struct HoleCount {
    std::size_t pixels = 0;   // whose rays meet ground
    std::size_t holes = 0;    // what is drawn is behind the ground, or nothing is
    std::size_t walls = 0;    // what is drawn is before the ground
    std::size_t closed = 0;   // what is drawn is ground that is not made, before the ground
    std::vector<Hole> where;  // holes and walls

    HoleCount& operator+=(const HoleCount& other);
};

// Draws the camera's view with the renderer's options and compares all of its pixels.
HoleCount findHoles(render::Renderer& renderer, ShownBlocks& blocks, const render::Camera& camera);

}  // namespace terrane::bench
