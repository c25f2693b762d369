#include "terrane/rays/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "terrane/base/result.h"

namespace terrane::rays {
namespace {

using shared::Ray, shared::RayHit, shared::RayPlace, shared::ShapeFace;
using world::ChunkPos;

const world::BlockRegistry& blocksOf(const SurfaceScene& scene, int level) {
    return level == 0 ? *scene.blocks : *scene.farBlocks;
}

// A cell where a ray is, with the ray in units of the cell from its lowest corner.
struct Cell {
    ChunkPos tile;
    const world::Chunk* chunk;
    int x, y, z;  // in the tile
    glm::dvec3 origin, direction;
};

Cell cellAt(const SurfaceScene& scene, const Ray& ray, const RayHit& hit) {
    const int level = hit.level;
    Cell cell{
        .tile = {hit.cell.x >> (4 + level), hit.cell.y >> (4 + level), static_cast<std::uint8_t>(level)},
        .chunk = nullptr,
        .x = hit.cell.x >> level & 15,
        .y = hit.cell.y >> level & 15,
        .z = hit.cell.z,
        .origin = glm::dvec3(0),
        .direction = glm::dvec3(0)};
    cell.chunk = scene.chunkAt(cell.tile);
    base::require(cell.chunk != nullptr, "forEachSurface: a tile of the scene has no chunk");
    for (int axis = 0; axis < 3; ++axis) {
        const int shift = axis < 2 ? level : 0;
        const bool isMirrored = ray.mirror[axis] != 0;
        const int first = ray.cell[axis] ^ ray.mirror[axis], low = hit.cell[axis] >> shift << shift;
        const double start = isMirrored ? 1.0 - double{ray.start[axis]} : double{ray.start[axis]};
        const double scale = std::ldexp(1.0, -shift);
        cell.origin[axis] = (static_cast<double>(first - low) + start) * scale;
        cell.direction[axis] = (isMirrored ? -1.0 : 1.0) * double{ray.direction[axis]} * scale;
    }
    return cell;
}

mesh::CellBlock blockAt(const world::Chunk& chunk, int x, int y, int z) {
    if (z < chunk.heights().bottom) return {world::kUnmade};
    if (z >= chunk.heights().top) return {};
    const world::BlockIndex at = world::blockIndex(x, y, z);
    return {chunk.block(at), chunk.blockState(at)};
}

// The block beside a cell. Where the scene has no tile of the same level it is not known, and counts as one
// of the same kind: so do meshes at open borders.
mesh::CellBlock blockBeside(const SurfaceScene& scene, const Cell& cell, glm::ivec3 at, world::BlockId self) {
    if (((at.x | at.y) & ~15) == 0) return blockAt(*cell.chunk, at.x, at.y, at.z);
    const world::Chunk* chunk = scene.chunkAt(world::offsetBy(cell.tile, at.x >> 4, at.y >> 4));
    if (chunk == nullptr) return {self, 0, false};
    return blockAt(*chunk, at.x & 15, at.y & 15, at.z);
}

mesh::CellSurroundings surroundingsOf(const SurfaceScene& scene, const Cell& cell,
                                      const world::BlockRegistry& blocks) {
    mesh::CellSurroundings around;
    around.self = blockAt(*cell.chunk, cell.x, cell.y, cell.z);
    const bool isLiquid = blocks.type(around.self.id).shape == world::Shape::Liquid;
    for (int side = 0; side < world::kFaceCount; ++side) {
        glm::ivec3 at(cell.x, cell.y, cell.z);
        at[side / 2] += side % 2 == 0 ? -1 : 1;
        const auto number = static_cast<std::size_t>(side);
        around.beside[number] = blockBeside(scene, cell, at, around.self.id);
        if (side >= 4 || !isLiquid) continue;
        ++at.z;
        around.aboveBeside[number] = blockBeside(scene, cell, at, around.self.id);
        if (((at.x | at.y) & ~15) != 0 && (at.z & 15) == 0) around.aboveBeside[number].isKnown = false;
    }
    return around;
}

struct FaceHit {
    double t;
    glm::dvec2 corner;  // along the axes of the face, 0 to 1
    bool isFront;
};

// Where a ray meets a triangle: at corner a + u (b − a) + v (c − a). T. Möller, B. Trumbore, Fast, Minimum
// Storage Ray-Triangle Intersection, Journal of Graphics Tools 1997. Borders count.
struct TriangleHit {
    double t, u, v;
    bool isFront;
};
std::optional<TriangleHit> hitTriangle(const Cell& cell, const glm::dvec3& a, const glm::dvec3& b,
                                       const glm::dvec3& c) {
    constexpr double kBorder = 1e-9;
    const glm::dvec3 alongU = b - a, alongV = c - a, p = glm::cross(cell.direction, alongV);
    const double determinant = glm::dot(alongU, p);
    if (determinant == 0) return std::nullopt;
    const glm::dvec3 from = cell.origin - a;
    const double u = glm::dot(from, p) / determinant;
    const glm::dvec3 q = glm::cross(from, alongU);
    const double v = glm::dot(cell.direction, q) / determinant;
    if (!(u >= -kBorder && v >= -kBorder && u + v <= 1 + kBorder)) return std::nullopt;
    return TriangleHit{glm::dot(alongV, q) / determinant, u, v, determinant > 0};
}

// A face is two triangles; corners are counterclockwise from the front at (0, 0), (1, 0), (1, 1) and (0, 1).
std::optional<FaceHit> hitFace(const Cell& cell, const ShapeFace& face) {
    const auto corner = [&](float u, float v) {
        const shared::vec4 at = shared::shapeFaceCorner(face, shared::vec4(0), {u, v}, {1, 1});
        return glm::dvec3(at);
    };
    const glm::dvec3 a = corner(0, 0), b = corner(1, 0), c = corner(0, 1), d = corner(1, 1);
    if (const auto hit = hitTriangle(cell, a, b, c)) return FaceHit{hit->t, {hit->u, hit->v}, hit->isFront};
    if (const auto hit = hitTriangle(cell, d, c, b))
        return FaceHit{hit->t, {1 - hit->u, 1 - hit->v}, hit->isFront};
    return std::nullopt;
}

glm::vec2 texelAt(const ShapeFace& face, const glm::dvec2& corner) {
    const auto at = glm::vec2(corner);
    const glm::vec2 lower = shared::shapeFaceTexel(face, {0, 0}),
                    right = shared::shapeFaceTexel(face, {1, 0});
    const glm::vec2 upper = shared::shapeFaceTexel(face, {0, 1}), far = shared::shapeFaceTexel(face, {1, 1});
    if (at.x + at.y <= 1) return lower + (right - lower) * at.x + (upper - lower) * at.y;
    return far + (upper - far) * (1 - at.x) + (right - far) * (1 - at.y);
}

// A side of a cube that the ray passes at t.
Surface cubeSurface(const Cell& cell, const mesh::CellFace& face, float t, bool isFront) {
    const glm::dvec3 at = cell.origin + cell.direction * double{t};
    // As the texture lies on the sides of a cube: from its upper left corner.
    const float x = static_cast<float>(at.x), y = static_cast<float>(at.y), z = static_cast<float>(at.z);
    const std::array<glm::vec2, 6> texels{glm::vec2{1 - y, 1 - z}, {y, 1 - z}, {x, 1 - z},
                                          {1 - x, 1 - z},          {x, y},     {x, 1 - y}};
    return {.tile = cell.tile,
            .block = world::blockIndex(cell.x, cell.y, cell.z),
            .face = face,
            .t = t,
            .texel = texels[face.shapeFace - shared::kShapeFaceCube],
            .isFront = isFront};
}

Surface opaqueCubeSurface(const Cell& cell, const RayHit& hit, const world::BlockRegistry& blocks) {
    const world::BlockId id = cell.chunk->block(world::blockIndex(cell.x, cell.y, cell.z));
    const std::uint16_t material = blocks.type(id).material[hit.face];
    const mesh::CellFace face{static_cast<std::uint16_t>(shared::kShapeFaceCube + hit.face), material,
                              blocks.materials()[material].twoSided};
    return cubeSurface(cell, face, hit.t, true);
}

// Where a ray leaves a cell: t, and the side.
struct CellExit {
    float t;
    world::Face side;
};
CellExit exitOf(const Ray& ray, const RayPlace& place, int level) {
    const glm::ivec4 end = shared::rayBoxEnd(place.cell, level, 0);
    CellExit exit{0, world::kFaceNegX};
    for (int axis = 0; axis < 3; ++axis) {
        const float t = shared::rayPlaneT(shared::rayDistance(ray.cell[axis], end[axis]), ray.start[axis],
                                          ray.inverse[axis]);
        if (axis == 0 || t < exit.t) exit = {t, static_cast<world::Face>(2 * axis + 1 + ray.mirror[axis])};
    }
    return exit;
}

std::optional<mesh::CellFace> cubeFaceOf(const SurfaceScene& scene, const Cell& cell, unsigned side,
                                         const world::BlockRegistry& blocks) {
    const mesh::CellBlock self = blockAt(*cell.chunk, cell.x, cell.y, cell.z);
    glm::ivec3 at(cell.x, cell.y, cell.z);
    at[static_cast<int>(side / 2)] += side % 2 == 0 ? -1 : 1;
    return mesh::cubeFace(self, blockBeside(scene, cell, at, self.id), static_cast<world::Face>(side),
                          blocks);
}

// Of a cube that is not opaque, a ray meets the side where it enters and the back of that where it leaves.
void addCubeSurfaces(const SurfaceScene& scene, const Ray& ray, const RayHit& hit, const Cell& cell,
                     SurfaceWalk& walk) {
    const world::BlockRegistry& blocks = blocksOf(scene, hit.level);
    if (hit.face < shared::kRayFaceNone) {
        if (const auto face = cubeFaceOf(scene, cell, hit.face, blocks))
            walk.surfaces.push_back(cubeSurface(cell, *face, hit.t, true));
    }
    const CellExit exit = exitOf(ray, walk.place, hit.level);
    if (exit.t > ray.start.w) return;
    if (const auto face = cubeFaceOf(scene, cell, exit.side, blocks); face && face->isTwoSided)
        walk.surfaces.push_back(cubeSurface(cell, *face, exit.t, false));
}

// Whether a ray passes a cell of liquid between cells of the same, still liquid: it meets nothing there.
bool isInsideLiquid(const SurfaceScene& scene, const Ray& ray, const RayHit& hit, const Cell& cell,
                    const SurfaceWalk& walk) {
    const mesh::CellBlock self = blockAt(*cell.chunk, cell.x, cell.y, cell.z);
    const auto isSame = [&](const mesh::CellBlock& other) {
        return other.id == self.id && other.state == self.state;
    };
    if (self.state != 0 || hit.face >= shared::kRayFaceNone ||
        !isSame(blockAt(*cell.chunk, cell.x, cell.y, cell.z + 1)))
        return false;
    const auto isSameBeside = [&](unsigned side) {
        glm::ivec3 at(cell.x, cell.y, cell.z);
        at[static_cast<int>(side / 2)] += side % 2 == 0 ? -1 : 1;
        return isSame(blockBeside(scene, cell, at, self.id));
    };
    return isSameBeside(hit.face) && isSameBeside(exitOf(ray, walk.place, hit.level).side);
}

void addShapeSurfaces(const SurfaceScene& scene, const Ray& ray, const Cell& cell, SurfaceWalk& walk) {
    const world::BlockRegistry& blocks = blocksOf(scene, cell.tile.level);
    walk.faces.clear();
    mesh::addCellFaces(surroundingsOf(scene, cell, blocks), blocks, walk.faces);
    for (const mesh::CellFace& face : walk.faces) {
        const ShapeFace& shape = scene.shapeFaces[face.shapeFace];
        const std::optional<FaceHit> met = hitFace(cell, shape);
        if (!met || met->t < 0 || met->t > double{ray.start.w} || !(met->isFront || face.isTwoSided))
            continue;
        walk.surfaces.push_back({cell.tile, world::blockIndex(cell.x, cell.y, cell.z), face,
                                 static_cast<float>(met->t), texelAt(shape, met->corner), met->isFront});
    }
    if (walk.surfaces.size() > 1)
        std::stable_sort(walk.surfaces.begin(), walk.surfaces.end(),
                         [](const Surface& a, const Surface& b) { return a.t < b.t; });
}

}  // namespace

StopTable drawnBlocks(const world::BlockRegistry& blocks) {
    return stopTable(blocks, [](const world::BlockType& type) { return type.shape != world::Shape::None; });
}

void addFacesOf(const SurfaceScene& scene, ChunkPos tile, glm::ivec3 inTile,
                std::vector<mesh::CellFace>& faces) {
    const Cell cell{.tile = tile,
                    .chunk = scene.chunkAt(tile),
                    .x = inTile.x,
                    .y = inTile.y,
                    .z = inTile.z,
                    .origin = glm::dvec3(0),
                    .direction = glm::dvec3(0)};
    base::require(cell.chunk != nullptr, "addFacesOf: the scene has no such tile");
    const world::BlockRegistry& blocks = blocksOf(scene, tile.level);
    mesh::addCellFaces(surroundingsOf(scene, cell, blocks), blocks, faces);
}

bool nextSurfaces(const SurfaceScene& scene, const Ray& ray, SurfaceWalk& walk) {
    walk.surfaces.clear();
    while (!walk.isOver && walk.surfaces.empty()) {
        const RayHit hit = shared::castRayFrom(scene.cells, ray, walk.place);
        walk.isOver = hit.face == shared::kRayMiss;
        if (walk.isOver) break;
        const world::BlockRegistry& blocks = blocksOf(scene, hit.level);
        const Cell cell = cellAt(scene, ray, hit);
        const world::BlockType& type =
            blocks.type(cell.chunk->block(world::blockIndex(cell.x, cell.y, cell.z)));
        if (type.opaqueCube) {
            walk.isOver = true;
            walk.isEnclosed = hit.face == shared::kRayFaceNone;
            if (!walk.isEnclosed) walk.surfaces.push_back(opaqueCubeSurface(cell, hit, blocks));
            break;
        }
        if (type.shape == world::Shape::Cube)
            addCubeSurfaces(scene, ray, hit, cell, walk);
        else if (type.shape != world::Shape::Liquid || !isInsideLiquid(scene, ray, hit, cell, walk))
            addShapeSurfaces(scene, ray, cell, walk);
        shared::rayLeaveBox(ray, walk.place, shared::rayBoxEnd(walk.place.cell, hit.level, 0));
    }
    return !walk.surfaces.empty();
}

}  // namespace terrane::rays
