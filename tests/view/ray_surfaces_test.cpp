// What rays see is what quads draw: distance and face of each pixel, of chunks and of tiles.
#include "terrane/rays/surfaces.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/hole_finder.h"
#include "terrane/mesh/shape_faces.h"
#include "tests/support/depth.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kRaysSize{160, 90};
constexpr int kRaysNear = 4, kRaysHorizon = 64;  // chunks
// Images of depth have 255 steps: of 1/16, 1/2 and 8 blocks.
constexpr double kTileSideDepth = 0.25;  // of quad.vert.glsl, in columns
constexpr std::array<float, 3> kSteps = {16, 128, 2048};

// The chunks and tiles that a session shows.
class ShownSurfaces {
  public:
    ShownSurfaces(game::Session& session, bench::ShownBlocks& blocks, world::ChunkPos center)
        : blocks_(blocks), farBlocks_(session.blocks().forFarTiles()) {
        std::vector<world::ChunkPos> shown;
        int levels = 1;
        for (const auto& [pos, record] : session.tiles().table().records) {
            if (!record.isShown) continue;
            shown.push_back(pos);
            levels = std::max(levels, 1 + pos.level);
        }
        cells_ = rays::makeScene(session.world().heights(), levels, 6);
        rays::moveScene(cells_, center);
        const rays::StopTable drawn = rays::drawnBlocks(session.blocks());
        const rays::StopTable farDrawn = rays::drawnBlocks(farBlocks_);
        for (const world::ChunkPos pos : shown)
            rays::setTile(cells_, pos,
                          rays::buildColumn(blocks.whole(pos), pos.level > 0 ? farDrawn : drawn));
        scene_.cells = rays::raysThrough(cells_);
        scene_.blocks = &session.blocks();
        scene_.farBlocks = &farBlocks_;
        scene_.shapeFaces = mesh::shapeFaces(session.blocks());
        scene_.chunkAt = [this](world::ChunkPos pos) {
            return rays::hasTile(cells_, pos) ? &blocks_.whole(pos) : nullptr;
        };
    }
    ShownSurfaces(const ShownSurfaces&) = delete;

    // What a pixel may show: surfaces that an alpha test may let through, which mipmaps decide, and the first
    // without one. Blended faces are not in images of depth.
    std::vector<rays::Surface> candidates(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const glm::dvec3 cell = glm::floor(origin);
        const shared::Ray ray =
            shared::makeRay(glm::ivec4(cell, 0), glm::vec4(origin - cell, 0), glm::vec4(direction, 0), 3e4f);
        std::vector<rays::Surface> found;
        rays::forEachSurface(scene_, ray, [&](const rays::Surface& surface) {
            const world::AlphaMode alpha = scene_.blocks->materials()[surface.face.material].alpha;
            if (alpha == world::AlphaMode::Blend || surface.t < render::kNearPlane) return false;
            found.push_back(surface);
            return !isTested(alpha);
        });
        return found;
    }

    static bool isTested(world::AlphaMode alpha) {
        return alpha == world::AlphaMode::Test || alpha == world::AlphaMode::TestGlow;
    }
    // Whether the sky may be seen through all of them.
    bool maySeeSky(const std::vector<rays::Surface>& found) const {
        return found.empty() || isTested(scene_.blocks->materials()[found.back().face.material].alpha);
    }

    // Whether a face does not go up.
    bool isFlat(const rays::Surface& surface) const {
        return scene_.shapeFaces[surface.face.shapeFace].axisV.z <= 0;
    }

    // Of a face along an axis that is lit as such; 0 of others.
    glm::vec3 normalOf(const rays::Surface& surface) const {
        const shared::ShapeFace& shape = scene_.shapeFaces[surface.face.shapeFace];
        if (shared::faceDirectionOf(shape) >= shared::kDirectionPlant) return glm::vec3(0);
        return mesh::normalOf(shape) * (surface.isFront ? 1.0f : -1.0f);
    }

  private:
    bench::ShownBlocks& blocks_;
    world::BlockRegistry farBlocks_;
    rays::Scene cells_;
    rays::SurfaceScene scene_;
};

struct Agreement {
    int pixels = 0, ground = 0;  // all; those that show something
    int tiles = 0, shapes = 0;   // of these, those of tiles, those of other faces than the sides of cubes
    int centers = 0;             // those that agree with the ray through their center
    int edges = 0;               // those that agree with another ray through them only
    // With none. A side of a tile lies deeper in the image of depth than it is, so that a face behind it may
    // be drawn in its place.
    int others = 0;

    Agreement& operator+=(const Agreement& other) {
        pixels += other.pixels;
        ground += other.ground;
        tiles += other.tiles;
        shapes += other.shapes;
        centers += other.centers;
        edges += other.edges;
        others += other.others;
        return *this;
    }
};

class RaySurfacesTest : public gpu::GlTest {
  protected:
    // The distance that an image of depth shows. The sides of tiles lie deeper in it than they are
    // (quad.vert.glsl).
    static double shownDistance(const rays::Surface& surface, const ShownSurfaces& shown, double forward) {
        if (surface.tile.level == 0 || shown.isFlat(surface)) return double{surface.t};
        return double{surface.t} + kTileSideDepth * (1 << surface.tile.level) / forward;
    }

    static bool fits(const rays::Surface& surface, const ShownSurfaces& shown, const bench::Interval& drawn,
                     double forward, const std::uint8_t* normal) {
        const double distance = shownDistance(surface, shown, forward), tolerance = 0.01 + 2e-4 * distance;
        if (distance < drawn.low - tolerance || distance > drawn.high + tolerance) return false;
        const glm::vec3 expected = 127.5f + 127.5f * shown.normalOf(surface);
        if (expected == glm::vec3(127.5f)) return true;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(expected[axis] - static_cast<float>(normal[axis])) > 2) return false;
        return true;
    }

    static Agreement compare(DrawnSession& player, const ShownSurfaces& shown, const render::Camera& camera) {
        const std::vector<bench::Interval> drawn = bench::drawnDistances(player.renderer, camera, kSteps);
        const base::Image normals =
            player.draw({camera, world::environmentAt(0.5f), 1e6f, 0, render::View::Normal});
        const bench::PixelRays rays(camera, kRaysSize);
        const glm::dvec3 look = render::lookDirection(camera);
        Agreement sum;
        for (int y = 0; y < kRaysSize.y; ++y) {
            for (int x = 0; x < kRaysSize.x; ++x) {
                const auto at = static_cast<std::size_t>(x + y * kRaysSize.x);
                const auto agrees = [&](double dx, double dy) {
                    const glm::dvec3 direction = rays.at(x + dx, y + dy);
                    const double forward = glm::dot(direction, look);
                    const auto found = shown.candidates(camera.position, direction);
                    if (drawn[at].low == bench::kNothing && shown.maySeeSky(found)) return true;
                    if (dx == 0 && dy == 0 && !found.empty()) {
                        ++sum.ground;
                        sum.tiles += found[0].tile.level > 0;
                        sum.shapes += found[0].face.shapeFace >= shared::kShapeFaceCross;
                    }
                    return std::any_of(found.begin(), found.end(), [&](const rays::Surface& surface) {
                        return fits(surface, shown, drawn[at], forward, &normals.rgba[4 * at]);
                    });
                };
                // Quads grow by up to a sixtieth of a pixel; depth decides at edges inside of a pixel.
                const auto agreesBeside = [&] {
                    for (const double step : {0.02, 0.1, 0.25, 0.5})
                        for (int k = 0; k < 9; ++k)
                            if (k != 4 && agrees(step * (k % 3 - 1), step * (k / 3 - 1))) return true;
                    return false;
                };
                ++sum.pixels;
                if (agrees(0, 0))
                    ++sum.centers;
                else
                    ++(agreesBeside() ? sum.edges : sum.others);
            }
        }
        return sum;
    }
};

TEST_F(RaySurfacesTest, RaysSeeWhatQuadsDraw) {
    DrawnSessionOptions options{.size = kRaysSize, .viewDistance = kRaysNear};
    options.render.distanceFog = false;
    const auto player = makeDrawnSession(std::move(options));
    player->view->setHorizon({kRaysHorizon, 8});
    bench::ShownBlocks blocks(*player->session);
    std::mt19937 random(3);
    const auto within = [&](int reach) { return std::uniform_int_distribution<int>(-reach, reach)(random); };
    Agreement sum;
    for (int k = 0; k < atDepth(12, 100); ++k) {
        const world::ChunkPos pos{within(300), within(300)};
        blocks.forget();
        const render::Camera camera = bench::randomCamera(blocks.whole(pos), pos, contentBlocks(), random);
        loadAll(*player->session, *player->view, camera, kRaysNear, std::chrono::steady_clock::now());
        const ShownSurfaces shown(*player->session, blocks, pos);
        const Agreement found = compare(*player, shown, camera);
        // Where few tiles are seen edge on, one after the other, there may be more than in all.
        EXPECT_LE(found.others, found.pixels / 500)
            << fmt::format("--at={},{},{} --look {},{}", camera.position.x, camera.position.y,
                           camera.position.z, camera.yaw, camera.pitch);
        sum += found;
    }
    fmt::print(
        "{} pixels, {} of ground ({} of tiles, {} of shapes that are no cubes): {} agree with the ray "
        "through "
        "their center, {} with another one, {} with none\n",
        sum.pixels, sum.ground, sum.tiles, sum.shapes, sum.centers, sum.edges, sum.others);
    EXPECT_LE(sum.others, sum.pixels / 2000);
    EXPECT_GT(sum.ground, sum.pixels / 2);
    EXPECT_GT(sum.tiles, 0);
    EXPECT_GT(sum.shapes, 0);
    EXPECT_GT(sum.centers, sum.pixels * 99 / 100);
}

}  // namespace
}  // namespace terrane::view
