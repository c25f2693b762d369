// Finds the nearest surface along a ray: the faces that meshes have (mesh/cell_faces.h), one cell after the other, as
// rays/surfaces.h does on the CPU. RAY_LAYER: see shared/variants.h. Needs frame_uniforms.glsl, shape_tables.glsl,
// block_texture.glsl, and alphaOf(), which decides about holes.
#include "terrane/shared/mesher.h"
#include "terrane/shared/packed_section.h"
#include "terrane/shared/ray_blocks.h"
#include "terrane/shared/ray_step.h"

layout(std430, binding = kRayWordsBinding) readonly buffer RayWordsBlock {
    uint rayWords[];
};
layout(std430, binding = kRayBlocksBinding) readonly buffer RayBlocksBlock {
    uint rayBlocks[];
};
layout(std430, binding = kRayTypesBinding) readonly buffer RayTypesBlock {
    MeshType rayTypes[];
};
layout(std430, binding = kRayFormsBinding) readonly buffer RayFormsBlock {
    uint rayForms[];
};
#include "terrane/shared/ray_cast.h"

const uint kBelowWorld = 0xFFFFu;  // as world::kUnmade
const float kNoSurface = 1e30;

struct Block {
    uint id;
    uint state;
    bool isKnown;
};

// A cell where the ray is. Lengths are in cells.
struct RayCell {
    int level;
    ivec2 tile;
    ivec3 at;        // in the tile
    uint blocks;     // of the tile, see ray_blocks.h
    vec3 scale;      // cells a block
    vec3 entry;      // of the ray into the cell, from its lowest corner
    vec3 direction;  // of the ray
    float t;         // at the entry
};

// What a ray meets.
struct RaySurface {
    float t;
    uint shapeFace;
    uint material;
    bool isFront;  // else the back of a two-sided face
};

// The ray, the cell where it is, and the nearest surface in it. In global variables: arguments would be copied.
vec3 rayAcrossPixel, rayUpPixel;  // from a pixel's ray to those of the pixels to the right and above
float rayLeastT, rayMostT;        // surfaces before and behind are not looked for
RayCell here;
Block self;
uint selfType;
RaySurface nearest;
vec2 nearestCorner;  // along its axes

uint sectionValue(uint word, uint number) {
    uint form = raySectionForm(word), place = raySectionPlace(word);
    if (form == 0u) return place;
    uint bits = 1u << (form - 1u);
    uint value = rayBlocks[place + (number * bits >> 5)] >> (number * bits & 31u) & ((1u << bits) - 1u);
    return bits == kDenseBits ? value : rayBlocks[place + rayIndexWords(bits) + value];
}

uint blocksOfTile(int level, ivec2 tile) {
    uint entry = rayEntryAt(0u, level, tile.x, tile.y);
    return entry == 0u ? 0u : rayBlocks[rayBlockEntry(entry)];
}

Block blockOf(uint blocks, ivec3 at) {
    if (at.z < frame.bottom) return Block(kBelowWorld, 0u, true);
    if (at.z >= frame.top) return Block(0u, 0u, true);
    uint section = blocks + kRaySectionWords * uint((at.z >> 4) - (frame.bottom >> 4));
    uint number = uint(at.x) | uint(at.y) << 4 | uint(at.z & 15) << 8;
    return Block(sectionValue(rayBlocks[section], number), sectionValue(rayBlocks[section + 1u], number), true);
}

// The block at a place beside the cell. Where no tile of the same level is, it is not known, and counts as one of the
// same kind: so do meshes at open borders.
Block blockAt(ivec3 at) {
    ivec2 away = at.xy >> 4;
    uint blocks = here.blocks;
    if (away != ivec2(0)) blocks = blocksOfTile(here.level, here.tile + away);
    if (blocks == 0u) return Block(self.id, 0u, false);
    return blockOf(blocks, ivec3(at.xy & 15, at.z));
}

ivec3 toward(uint side) {
    int along = (side & 1u) == 0u ? -1 : 1;
    uint axis = side >> 1;
    return ivec3(axis == 0u ? along : 0, axis == 1u ? along : 0, axis == 2u ? along : 0);
}

Block blockBeside(uint side) {
    return blockAt(here.at + toward(side));
}

// Block types of far tiles follow those of chunks.
uint typeOf(uint id) {
    uint count = uint(rayTypes.length()) / 2u;
    return min(id, count - 1u) + (here.level > 0 ? count : 0u);
}

bool isOpaque(Block block) {
    return (rayTypes[typeOf(block.id)].flags & kMeshOpaqueBit) != 0u;
}

bool isSideVisible(Block beside, uint side) {
    if (isOpaque(beside)) return false;
    return beside.id != self.id || (rayTypes[selfType].flags >> (kMeshHidesShift + side) & 1u) == 0u;
}

// Material and draw bucket of a side. The state of a growing plant counts the stages left.
uint faceOfSide(uint side) {
    uint forms = rayTypes[selfType].forms, left = min(self.state, forms >> 16);
    return left > 0u ? rayForms[(forms & 0xFFFFu) + left - 1u] : rayTypes[selfType].faces[side];
}

bool isBlended(uint face) {
    return face >> 17 == uint(ALPHA_BLENDED);
}

// A face as a fragment sees it.
struct FaceLook {
    uint packedFace;  // packed_face.glsl
    vec2 texel, dx, dy;
};

float alphaOf(FaceLook look);

// `t`, `corner`: where the ray meets it. Texture coordinates change linearly on each of two triangles. A pixel to the
// side meets the same plane at another distance.
FaceLook lookOf(uint number, uint material, float t, vec2 corner) {
    MaterialRecord record = materialOf(material);
    ShapeFace face = shapeFaceOf(number, record);
    vec2 lower = texelOf(number, face, vec2(0.0)), right = texelOf(number, face, vec2(1.0, 0.0));
    vec2 upper = texelOf(number, face, vec2(0.0, 1.0)), far = texelOf(number, face, vec2(1.0));
    FaceLook look;
    uint direction = faceDirectionOf(face);
    look.packedFace = packFace(Quad(0u, 0u), record, uint(here.level), direction);
#if FACE_SAMPLING == 1
    inSampling = optionsSampling(record.options);
#endif
    vec2 extent = extentOf(look.packedFace);
    vec2 rest = 1.0 - corner;
    look.texel = extent * (corner.x + corner.y <= 1.0 ? lower + (right - lower) * corner.x + (upper - lower) * corner.y
                                                     : far + (upper - far) * rest.x + (right - far) * rest.y);
    vec3 u = face.axisU.xyz, v = face.axisV.xyz, normal = cross(u, v);
    float slope = dot(here.direction, normal), area = dot(normal, normal);
    for (int k = 0; k < 2; ++k) {
        vec3 aside = (k == 0 ? rayAcrossPixel : rayUpPixel) * here.scale * t;
        vec3 moved = aside - here.direction * (dot(aside, normal) / slope);
        vec2 along = vec2(dot(cross(moved, v), normal), dot(cross(u, moved), normal)) / area;
        vec2 change = extent * ((right - lower) * along.x + (upper - lower) * along.y);
        if (k == 0) look.dx = change;
        else look.dy = change;
    }
    return look;
}

// Keeps a face that the ray meets at t, unless a nearer one is known or its texel there is a hole.
void offerAt(uint number, uint face, float t, vec2 corner, bool isFront) {
    if (t < rayLeastT || t >= nearest.t || t > rayMostT) return;
#if RAY_LAYER == RAY_SURFACES
    if (face >> 17 == uint(ALPHA_TESTED)) {
        FaceLook look = lookOf(number, face & 0xFFFFu, t, corner);
        if (alphaOf(look) < minAlpha(look.packedFace)) return;
    }
#endif
    nearest = RaySurface(t, number, face & 0xFFFFu, isFront);
    nearestCorner = corner;
}

bool isSought(uint face) {
    return isBlended(face) == (RAY_LAYER != RAY_SURFACES);
}

// The lowest corner of a face along its axes: shapeFaceCorner() of corner (0, 0).
vec3 originOf(ShapeFace face) {
    return face.base.xyz - negativePart4(face.axisU).xyz - negativePart4(face.axisV).xyz;
}

// Offers a side of a cube that the ray passes at t.
void offerSide(uint side, uint face, float t, bool isFront) {
    if (!isSought(face)) return;
    ShapeFace shape = shapeFaceOf(kShapeFaceCube + side, materialOf(face & 0xFFFFu));
    vec3 place = here.entry + here.direction * (t - here.t) - originOf(shape);
    vec2 corner = vec2(dot(place, shape.axisU.xyz), dot(place, shape.axisV.xyz));
    offerAt(kShapeFaceCube + side, face, t, clamp(corner, 0.0, 1.0), isFront);
}

// Where the ray meets a plane: t from the entry, and the place along two axes. T. Möller, B. Trumbore, Fast, Minimum
// Storage Ray-Triangle Intersection, Journal of Graphics Tools 1997.
vec4 meetPlane(vec3 origin, vec3 u, vec3 v) {
    vec3 p = cross(here.direction, v);
    float determinant = dot(u, p);
    vec3 from = here.entry - origin, q = cross(from, u);
    vec3 found = vec3(dot(v, q), dot(from, p), dot(here.direction, q)) / determinant;
    return determinant == 0.0 ? vec4(0.0, -1.0, -1.0, 0.0) : vec4(found, determinant);
}

// Rays through the border between two faces may round to either side: both have it.
const float kFaceBorder = 1.0 / 4096.0;

// Offers any face of the cell. With a bend it is two triangles.
void offerFace(uint number, uint face, bool isTwoSided) {
    if (!isSought(face)) return;
    MaterialRecord material = materialOf(face & 0xFFFFu);
    ShapeFace shape = shapeFaceOf(number, material);
    vec3 origin = originOf(shape);
    if (lookAnimation(material.look) == kAnimationLiquidSurface)
        origin -= kLiquidInset * here.scale * normalOf(faceDirectionOf(shape));
    vec3 u = shape.axisU.xyz, v = shape.axisV.xyz;
    vec4 met = meetPlane(origin, u, v);
    vec2 corner = met.yz;
    bool isBent = shape.bend.xyz != vec3(0.0), isFirst = met.y + met.z <= 1.0 + kFaceBorder;
    if (isBent && !isFirst) {
        vec3 far = origin + u + v + shape.bend.xyz;
        met = meetPlane(far, origin + v - far, origin + u - far);
        corner = 1.0 - met.yz;
        isFirst = met.y + met.z <= 1.0 + kFaceBorder;
    }
    if (isBent && !isFirst) return;
    if (any(lessThan(corner, vec2(-kFaceBorder))) || any(greaterThan(corner, vec2(1.0 + kFaceBorder)))) return;
    bool isFront = met.w > 0.0;
    if (!isFront && !isTwoSided && (face >> 16 & 1u) == 0u) return;
    offerAt(number, face, here.t + met.x, clamp(corner, 0.0, 1.0), isFront);
}

void offerSides(uint first, uint end, uint shapeFaceOfNegX) {
    for (uint side = first; side < end; ++side) {
        uint face = faceOfSide(side);
        if (isSought(face) && isSideVisible(blockBeside(side), side)) offerFace(shapeFaceOfNegX + side, face, false);
    }
}

// Plane k has the material of side k.
void offerPlanes(uint first, uint count) {
    for (uint k = 0u; k < count; ++k) offerFace(first + k, faceOfSide(k), false);
}

void offerModel() {
    uint forms = rayTypes[selfType].forms;
    uint form = rayForms[(forms & 0xFFFFu) + (self.state & (forms >> 16))];
    uint first = form & 0xFFFFFFu, end = first + (form >> 24);
    for (uint k = first; k < end; ++k) {
        uint face = rayForms[k], hiddenBy = face >> kMeshFaceHiddenByShift & 7u;
        if (hiddenBy < 6u) {
            Block beside = blockBeside(hiddenBy);
            if (beside.isKnown && isOpaque(beside)) continue;
        }
        offerFace(face & 2047u, rayTypes[selfType].faces[face >> kMeshFaceLookShift & 7u],
                  (face & kMeshFaceTwoSidedBit) != 0u);
    }
}

// Liquids: the rules of mesh/cell_faces.cpp.
const uint kHeightOfStill = kFlowHeights - 1u, kHeightOfFull = kFlowHeights;

uint flowHeightOf(uint form) {
    return (form & kMeshFlowFalling) != 0u ? kHeightOfFull : kHeightOfStill - form;
}

void offerFlowSide(uint side, uint low, uint high) {
    if (low < high) offerFace(flowSideFace(side, low, high), rayTypes[selfType].faces[side], false);
}

// Whether the still liquid beside is full. The block above it is not known in another tile and another section.
bool isStillFullBeside(uint side) {
    ivec3 at = here.at + toward(side) + ivec3(0, 0, 1);
    if (at.xy >> 4 != ivec2(0) && (at.z & 15) == 0) return false;
    Block above = blockAt(at);
    return above.isKnown && (above.id == self.id || isOpaque(above));
}

void offerStep(uint side, Block beside, uint form, uint height) {
    if (!beside.isKnown || beside.id != self.id) return;
    uint next = beside.state & kMeshFlowMask;
    if (form == 0u && next == 0u) return;
    uint low = next == 0u && isStillFullBeside(side) ? kHeightOfFull : flowHeightOf(next);
    offerFlowSide(side, low, height);
}

void offerLevelSide(uint side, bool isVisible) {
    if (isVisible) offerFace(kShapeFaceCube + side, rayTypes[selfType].faces[side], false);
}

void offerLiquid() {
    uint form = self.state & kMeshFlowMask;
    bool isTopVisible = isSideVisible(blockBeside(5u), 5u), isSurface = form == 0u && isTopVisible;
    uint height = form != 0u ? flowHeightOf(form) : isSurface ? kHeightOfStill : kHeightOfFull;
    for (uint side = 0u; side < 4u; ++side) {
        Block beside = blockBeside(side);
        offerStep(side, beside, form, height);
        if (!isSideVisible(beside, side)) continue;
        if (form != 0u) offerFlowSide(side, 0u, height);
        else if (isSurface) offerFace(kShapeFaceLiquidSide + side, rayTypes[selfType].faces[side], false);
        else offerLevelSide(side, true);
    }
    offerLevelSide(4u, isSideVisible(blockBeside(4u), 4u));
    uint top = rayTypes[selfType].faces[5];
    if (isSurface) offerFace(kShapeFaceLiquidTop, top, false);
    else if ((form & kMeshFlowFalling) != 0u) offerLevelSide(5u, isTopVisible);
    else if (form != 0u) offerFace(kShapeFaceFlowTop + form - 1u, top, false);
}

struct CellExit {
    float t;
    uint side;
};
CellExit exitOf(Ray ray, ivec4 cell) {
    ivec4 end = rayBoxEnd(cell, here.level, 0);
    CellExit exit = CellExit(kNoSurface, 0u);
    for (int axis = 0; axis < 3; ++axis) {
        float t = rayPlaneT(rayDistance(ray.cell[axis], end[axis]), ray.start[axis], ray.inverse[axis]);
        if (t < exit.t) exit = CellExit(t, uint(2 * axis + 1 + ray.mirror[axis]));
    }
    return exit;
}

// A ray meets the side of a cube where it enters, and the back of that where it leaves.
void offerCube(uint entered, CellExit exit) {
    if (entered < kRayFaceNone && isSideVisible(blockBeside(entered), entered))
        offerSide(entered, faceOfSide(entered), here.t, true);
    uint face = faceOfSide(exit.side);
    if (isSought(face) && (face >> 16 & 1u) != 0u && isSideVisible(blockBeside(exit.side), exit.side))
        offerSide(exit.side, face, exit.t, false);
}

bool isSameStill(Block beside) {
    return beside.id == self.id && beside.state == self.state;
}

// Whether the ray passes a cell of liquid between cells of the same, still liquid: it meets nothing there.
bool isInsideLiquid(uint entered, CellExit exit) {
    return self.state == 0u && entered < kRayFaceNone && isSameStill(blockBeside(5u)) &&
           isSameStill(blockBeside(entered)) && isSameStill(blockBeside(exit.side));
}

void offerCell(uint entered, CellExit exit) {
    uint shape = rayTypes[selfType].flags & kMeshShapeMask;
    if (shape == kMeshShapeCube) {
        offerCube(entered, exit);
    } else if (shape == kMeshShapeLiquid) {
        if (!isInsideLiquid(entered, exit)) offerLiquid();
    } else if (shape == kMeshShapeCross) {
        offerPlanes(kShapeFaceCross, 2u);
    } else if (shape == kMeshShapeHash) {
        offerPlanes(kShapeFaceHash, 4u);
    } else if (shape == kMeshShapeInset) {
        offerPlanes(kShapeFaceInset, 4u);
        offerSides(4u, 6u, kShapeFaceCube);
    } else if (shape == kMeshShapeModel) {
        offerModel();
    }
}

void enterCell(Ray ray, RayHit hit) {
    ivec3 mirror = ray.mirror.xyz;
    here.level = hit.level;
    here.tile = hit.cell.xy >> (4 + hit.level);
    here.at = ivec3(hit.cell.xy >> hit.level & 15, hit.cell.z);
    here.blocks = blocksOfTile(here.level, here.tile);
    here.scale = vec3(vec2(1.0 / float(1 << hit.level)), 1.0);
    here.t = hit.t;
    bvec3 isMirrored = notEqual(mirror, ivec3(0));
    vec3 along = mix(ray.direction.xyz, -ray.direction.xyz, isMirrored);
    vec3 start = mix(ray.start.xyz, 1.0 - ray.start.xyz, isMirrored);
    ivec3 low = ivec3(hit.cell.xy >> hit.level << hit.level, hit.cell.z);
    here.direction = along * here.scale;
    here.entry = clamp((vec3((ray.cell.xyz ^ mirror) - low) + start + along * hit.t) * here.scale, 0.0, 1.0);
    if (hit.face < kRayFaceNone) here.entry[int(hit.face >> 1)] = float(hit.face & 1u);
    self = blockOf(here.blocks, here.at);
    selfType = typeOf(self.id);
}

// A ray from a point, in blocks from the corner of the camera's chunk at z = 0.
Ray rayFrom(vec3 point, vec3 direction, float end) {
    vec3 low = floor(point);
    ivec3 cell = ivec3(int(kChunkSize) * frame.cameraChunk, 0) + ivec3(low);
    return makeRay(ivec4(cell, 0), vec4(point - low, 0.0), vec4(direction, 0.0), end);
}

const float kEndOfRays = 1048576.0;  // blocks

// Finds the nearest surface between two t, in `nearest`, and its cell in `here`. A ray that begins in an opaque cube
// meets nothing before it has left such cubes.
bool findSurface(Ray ray) {
    RayPlace place = rayBegin(ray);
    nearest = RaySurface(kNoSurface, 0u, 0u, true);
    rayMostT = ray.start.w;
    bool isEnclosed = false;
    for (;;) {
        RayHit hit = castRayFrom(0u, ray, place);
        if (hit.face == kRayMiss) return false;
        isEnclosed = hit.face == kRayFaceNone || (isEnclosed && hit.t == here.t);
        enterCell(ray, hit);
        CellExit exit = exitOf(ray, place.cell);
        if ((rayTypes[selfType].flags & kMeshOpaqueBit) == 0u) {
            isEnclosed = false;
            offerCell(hit.face, exit);
        } else if (!isEnclosed) {
            offerSide(hit.face, faceOfSide(hit.face), hit.t, true);
            isEnclosed = true;  // if that is before the near plane
        }
        if (nearest.t < kNoSurface) return true;
        rayLeaveBox(ray, place, rayBoxEnd(place.cell, hit.level, 0));
        here.t = place.t;
        if (!(place.t <= ray.start.w)) return false;
    }
}
