#include <deque>
#include <string>

#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// Caves of wilderness. Storeys of rooms and passages are hollows between a floor and a roof by column, so
// that a pass over columns finds them, with their lakes, stalactites and what their walls are made of; the
// pass over voxels only compares heights. Tunnels in space connect storeys.
//
// Water is held because nothing opens the rock around it: below the level of a storey's lake only the storey
// itself is open, unless its floor is well above that level there.

namespace terrane::gen::wilderness {

namespace {

struct StoreyKind {
    const char* name;
    float middle, vary;   // z of passages: this and as much more or less
    float room, deep;     // blocks: how high rooms rise above the middle, how deep they reach below
    int lake, lakeFloor;  // z of the water's surface and of its deepest ground
    bool isBelowLand;     // whether it is found everywhere, not only inside of mountains
};

// From above. The lowest one is a lake wherever it is open below its level.
constexpr StoreyKind kKinds[kStoreys] = {{"mountain", 560, 110, 95, 8, kNoLake, kNoLake, false},
                                         {"hill", 150, 45, 80, 8, kNoLake, kNoLake, false},
                                         {"upper", -48, 16, 62, 10, -58, -74, true},
                                         {"middle", -162, 20, 104, 14, -176, -198, true},
                                         {"deep", -345, 30, 128, 34, -372, kNoLake, true}};
constexpr int kUpper = 2, kMiddle = 3, kDeep = kStoreys - 1;
constexpr float kPassage = 13, kPassageDeep = 4;  // blocks: like `room` and `deep`
constexpr int kSealed = 5;                        // blocks of rock below lakes
constexpr int kNowhere = -10000;                  // z
constexpr float kFar = kNowhere;
constexpr float kFewest = 0.25f;  // share of caves below which there are only tunnels
constexpr float kStem = 40;       // blocks: stems of mushrooms reach into the ground

std::string named(const StoreyKind& kind, const char* what) {
    return std::string(kind.name) + " cave " + what;
}

// Rock and climate that caves depend on, by column.
struct Country {
    Float many;       // share: how many caves there are
    Float limestone;  // share
    Float hot;        // above 0: lava in the deep
    Float forest;     // share: warm and wet land, whose caves have fungi
    Float crystals;   // above 0: rooms of crystal
    Bool isCold, isVolcano;
};

Float cavePlaces(Pass& p) {
    return p.perlin2D("cave places", 128, {.5f, 1.0f});
}

Float manyCaves(Pass& p, Float limestone) {
    return smoothstep(-0.35f, 0.15f, cavePlaces(p) + limestone * 0.4f);
}

Country country(Pass& p, const Fields& f) {
    const Float volcanic = p.read(f.volcanic), limestone = limestoneShare(p, f);
    return {manyCaves(p, limestone),
            limestone,
            p.perlin2D("hot rock", 512, {.4f, 1.0f}) + volcanic * 2.0f,
            smoothstep(0.12f, 0.3f, p.read(f.moisture)) * smoothstep(-0.25f, -0.1f, p.read(f.temperature)),
            p.perlin2D("crystal caves", 128, {.4f, 1.0f}) - 0.45f,
            p.read(f.cold) < -0.46f,
            volcanic > 0.12f};
}

// How high above and how deep below its middle a storey is open, in blocks; 0 where it is rock.
struct Hollow {
    Float up, down;
};

Float rounded(Float share) {
    return share * (2.0f - share);
}

// `wider`: 0, or more to find what is near a hollow.
Hollow hollowAt(Pass& p, const StoreyKind& kind, Float many, float wider) {
    const Float room = p.perlin2D(named(kind, "rooms"), 160, {.22f, .5f, 1.0f});
    const Float line = abs(p.simplex2D(named(kind, "passages"), 96, {.2f, .45f, 1.0f}));
    const Float inRoom = clamp((room - 1.06f + many * 0.72f + wider * 0.05f) * 3.4f, 0.0f, 1.0f);
    const Float inPassage = clamp((many * 1.4f - 0.4f) + wider - line * (1.0f / 0.07f), 0.0f, 1.0f);
    return {max(rounded(inRoom) * kind.room, rounded(inPassage) * kPassage),
            max(min(inRoom * 3.0f, Float(1.0f)) * kind.deep, inPassage * kPassageDeep)};
}

struct Drip {
    Float cone;  // blocks
    Float kind;  // 0…1, the same for all columns of a cone
};

// Cones that hang from roofs and stand below them, of the length that a gap allows.
Drip drip(Pass& p, Float gap, Float chance) {
    const Voronoi2D at = p.voronoi2D("drips", 9, 1);
    const Int x = p.x() + at.offset.x, y = p.y() + at.offset.y;
    const Float size = p.random2D("drip size", x, y);
    const Bool isDrip = p.random2D("is drip", x, y) < chance;
    const Float radius = size * size * 3.2f + 0.9f;
    const Float cone = clamp(1.0f - at.distance / radius, 0.0f, 1.0f);
    const Float thin = cone * (cone * 0.7f + 0.3f);
    return {select(isDrip, thin * (size * 0.5f + 0.15f) * min(gap, Float(46.0f)), Float(0.0f)),
            p.random2D("kind of drip", x, y)};
}

// What the walls and the ground of a storey's caves are made of.
struct Lining {
    Block wall, ground;  // a wall of "crystal": rock with lumps of it
    Float drips;         // share of the places for stalactites that have one
    Float crystals;      // share of these that are crystals
    Float fungus;        // share
};

Lining liningOf(Pass& p, const Fields& f, int storey, const Country& c, Bool isBuried) {
    const Block rock = p.read(f.rock);
    const Float patches = p.perlin2D("cave walls", 14, {.5f, 1.0f});
    const auto block = [&](const char* name) { return p.block(name); };
    const bool isUnderSky = storey <= kUpper;
    Float fungus = min(c.forest, smoothstep(0.6f, 0.3f, cavePlaces(p)));
    if (!isUnderSky) fungus = min(fungus, smoothstep(-0.1f, 0.3f, p.perlin2D("fungus caves", 256, {1.0f})));
    const Bool isFungus = fungus + patches * 0.15f > 0.5f;
    const Bool isCrystal = !isUnderSky && c.crystals > patches * 0.1f;
    const Bool isHot = storey == kDeep ? c.hot > 0.0f : c.isVolcano;
    const Bool isIce = isUnderSky ? c.isCold : Bool(false);
    const Block druse = select(patches > 0.32f, block("crystal_rock"), block("basalt"));
    // Crystals in walls and roofs, more of them in the depth, so that one sees how large a room is.
    const Bool isLit = patches < (isUnderSky ? -0.62f : -0.5f) && isBuried;
    const Block mossy = select(patches > 0.1f, block("mossy_stone"), rock);
    return {multiSelect({{isLit, block("crystal")},
                         {isIce, select(patches > 0.55f, block("snow"), block("ice"))},
                         {isHot, block("basalt")},
                         {isCrystal, druse},
                         {isFungus, mossy},
                         {c.limestone > 0.5f, block("limestone")}},
                        rock),
            multiSelect({{isLit, block("crystal_rock")},
                         {isIce, select(patches > 0.1f, block("snow"), block("ice"))},
                         {isHot, select(patches > 0.5f, block("gravel"), block("basalt"))},
                         {isCrystal, druse},
                         {isFungus, select(patches > 0.35f, block("mud"), block("moss"))},
                         {patches > 0.3f, block("gravel")},
                         {patches < -0.5f, block("clay")}},
                        rock),
            multiSelect({{isHot, Float(0.15f)}, {isIce || isCrystal, Float(0.75f)}, {isFungus, Float(0.3f)}},
                        c.limestone * 0.75f + 0.2f),
            select(isCrystal || isHot, Float(0.6f), Float(isUnderSky ? 0.0f : 0.14f)), fungus};
}

// Mushrooms as high as trees on the ground of a fungus cave. A cap needs a wider gap, drier ground (blocks
// above the lake) and more fungus than a stem, so that every cap has one.
void growMushrooms(Pass& p, Float middle, Float gap, Float dry, Float fungus, Var<Int>& low, Var<Int>& high) {
    const Voronoi2D at = p.voronoi2D("cave mushrooms", 15, 1);
    const Int x = p.x() + at.offset.x, y = p.y() + at.offset.y;
    const Float size = p.random2D("cave mushroom size", x, y);
    const Float radius = size * 3.0f + 2.2f, plane = floor(middle + size * 9.0f - 1.0f);
    const Bool isStem = at.distance < 0.9f;
    const Bool isHere = at.distance < radius && size > 0.25f && gap > at.distance * 4.0f + 20.0f &&
                        dry > at.distance * 1.5f + 1.0f && fungus > at.distance * 0.06f + 0.5f;
    const Float bulge = sqrt(max(radius * radius - at.distance * at.distance, Float(0.0f))) * 0.6f;
    const Float foot = select(isStem, plane - kStem, plane + bulge - 2.0f);
    low = select(isHere, Int(floor(foot)), static_cast<Int>(low));
    high = select(isHere, Int(floor(plane + bulge)), static_cast<Int>(high));
}

}  // namespace

Float limestoneShare(Pass& p, const Fields& f) {
    const Float kinds = p.perlin2D("kinds of rock", 512, {.1f, .2f, .5f, 1.0f});
    const Float flat = smoothstep(0.3f, 0.15f, p.read(f.range)) * smoothstep(0.05f, 0.0f, p.read(f.volcanic));
    const Float karst = karstLand(p.read(f.temperature), p.read(f.moisture));
    return max(smoothstep(0.02f, 0.12f, karst), smoothstep(0.4f, 0.5f, kinds)) * flat;
}

CaveFields::CaveFields(GeneratorBuilder& g) {
    for (int k = 0; k < kStoreys; ++k) {
        const std::string name = kKinds[k].name;
        storeys[k] = {g.field<Int>(name + " floor"),      g.field<Int>(name + " roof"),
                      g.field<Int>(name + " wall floor"), g.field<Int>(name + " wall roof"),
                      g.field<Int>(name + " lake"),       g.field<Block>(name + " wall"),
                      g.field<Block>(name + " ground"),   g.field<Block>(name + " pool")};
    }
    mushroomLow = g.field<Int>("mushroom low");
    mushroomHigh = g.field<Int>("mushroom high");
    riverFloor = g.field<Int>("river cave floor");
    riverRoof = g.field<Int>("river cave roof");
    riverTop = g.field<Int>("river cave water");
    riverSeal = g.field<Int>("river cave seal");
}

Bool isShaft(Pass& p, const Fields& f) {
    const Voronoi2D at = p.voronoi2D("shafts", 256, 1);
    const Int x = p.x() + at.offset.x, y = p.y() + at.offset.y;
    const Float radius = p.random2D("shaft size", x, y) * 6.0f + 4.0f;
    const Float surface = p.read(f.height);
    const Bool isPlace =
        surface > kSea + 4.0f && surface < kSea + 110.0f && p.read(f.wet) <= 0.0f && p.read(f.land) > 0.03f;
    Var<Bool> result = p.var(Bool(false));
    p.if_(isPlace && at.distance < radius + 2.0f, [&] {
        const Float edge = radius + p.simplex2D("shaft edges", 8, {.6f, 1.0f});
        const Hollow h = hollowAt(p, kKinds[kUpper], manyCaves(p, limestoneShare(p, f)), 0.0f);
        result = at.distance < edge && h.up > 3.0f;
    });
    return result;
}

namespace {

// A storey in a column before its caves meet those of other storeys.
struct Room {
    explicit Room(Pass& p)
        : middle(p.var(Float(0.0f))),
          bottom(p.var(Float(-kFar))),
          high(p.var(Float(kFar))),
          evenBottom(p.var(Float(-kFar))),
          evenHigh(p.var(Float(kFar))),
          cone(p.var(Float(0.0f))),
          fungus(p.var(Float(0.0f))),
          lake(p.var(Int(kNowhere))),
          wallFloor(p.var(Int(-kNowhere))),
          wallRoof(p.var(Int(kNowhere))),
          wall(p.var(p.block("stone"))),
          ground(p.var(p.block("stone"))),
          pool(p.var(p.block("water"))) {}

    Var<Float> middle;                // z of passages
    Var<Float> bottom, high;          // z of the ground and the roof, without stalactites
    Var<Float> evenBottom, evenHigh;  // these without bumps
    Var<Float> cone;                  // blocks: stalactite
    Var<Float> fungus;                // share
    Var<Int> lake, wallFloor, wallRoof;
    Var<Block> wall, ground, pool;
};

void findRoom(Pass& p, const Fields& f, const Country& c, int storey, Room& room) {
    const StoreyKind& kind = kKinds[storey];
    const Float surface(p.read(f.surface));
    p.if_(surface > kind.middle - kind.vary - kind.deep && c.many > kFewest, [&] {
        const Hollow h = hollowAt(p, kind, c.many, 0.0f), near = hollowAt(p, kind, c.many, 0.35f);
        const Float middle = p.perlin2D(named(kind, "heights"), 256, {.4f, 1.0f}) * kind.vary + kind.middle;
        Float low = middle - h.down;
        if (kind.lakeFloor != kNoLake) low = max(low, Float(static_cast<float>(kind.lakeFloor)));
        if (kind.lake != kNoLake) {
            const auto level = static_cast<float>(kind.lake);
            // Dry near the surface, and between water and lava.
            const Float border = storey == kDeep ? abs(c.hot) : abs(p.read(f.volcanic) - 0.12f) * 3.0f;
            const Bool isDry = surface < level + 24.0f || border < 0.05f;
            const Bool isHot = storey == kDeep ? c.hot > 0.0f : c.isVolcano;
            low = select(isDry, max(low, Float(level + 2.0f)), low);
            room.lake = select(storey == kDeep ? !isDry : low < level + 5.0f, Int(kind.lake), Int(kNowhere));
            room.pool = select(isHot, p.block("lava"), p.block("water"));
        }
        p.if_(near.up > 1.0f, [&] {
            const Lining lining = liningOf(p, f, storey, c, surface > middle + near.up + 16.0f);
            room.wall = lining.wall;
            room.ground = lining.ground;
            room.wallFloor = Int(floor(middle - near.down)) - 3;
            room.wallRoof = Int(floor(middle + near.up)) + 4;
            p.if_(h.up > 1.5f, [&] {
                const Float bumps = p.perlin2D("cave floors", 9, {.5f, 1.0f});
                const Float rough = p.perlin2D("cave roofs", 15, {.4f, .7f, 1.0f});
                const Float high = middle + h.up - (rough + 1.0f) * min(h.up * 0.16f, Float(7.0f));
                const Float bottom = low + (bumps + 0.6f) * min(h.up * 0.1f, Float(2.2f));
                const Float gap = high - bottom;
                room.middle = middle;
                room.bottom = bottom;
                room.evenBottom = low;
                room.evenHigh = middle + h.up;
                room.high = high;
                const Drip d = drip(p, gap, lining.drips);
                const Bool isCrystal = d.cone > 0.0f && d.kind < lining.crystals;
                room.cone = d.cone * smoothstep(6.0f, 12.0f, gap);
                room.wall = select(isCrystal, p.block("crystal_rock"), lining.wall);
                room.ground = select(isCrystal, p.block("crystal_rock"), lining.ground);
                room.fungus = lining.fungus;
            });
        });
    });
}

}  // namespace

void underSurfacePass(Pass& p, const Fields& f) {
    const CaveFields& caves = *f.caves;
    const Country c = country(p, f);
    const Int surface = p.read(f.surface), caveTop = p.read(f.caveTop);
    const Bool isShaft = caveTop > surface + kShaftMark / 2;
    Var<Int> mushroomLow = p.var(Int(-kNowhere)), mushroomHigh = p.var(Int(kNowhere));
    std::deque<Room> rooms;
    for (int k = 0; k < kStoreys; ++k) rooms.emplace_back(p);
    for (int k = 0; k < kStoreys; ++k) findRoom(p, f, c, k, rooms[static_cast<std::size_t>(k)]);
    // From above. Where a room is high enough it opens the floor of the room above it, else a plate of rock
    // stays between them, and below lakes.
    Float ceiling(-kFar);
    Bool isHoleAbove = false;
    for (int k = 0; k < kStoreys; ++k) {
        const StoreyKind& kind = kKinds[k];
        Room& room = rooms[static_cast<std::size_t>(k)];
        const Storey& s = caves.storeys[k];
        const Float bottom = room.bottom, high = room.high;
        const Bool isOpen = high > bottom, isWet = static_cast<Int>(room.lake) > kNowhere;
        // How much rock is left between this floor and the roof of the storey below.
        Float rock(-kFar);
        if (k < kDeep) {
            const Float below = rooms[static_cast<std::size_t>(k) + 1].evenHigh;
            rock = select(isWet, Float(-kFar), room.evenBottom - below);
        }
        const Bool isHole = rock < -6.0f;  // of the floor
        const Float cone = select(isHoleAbove, Float(0.0f), static_cast<Float>(room.cone));
        const Float roof = min(high, ceiling);
        const Int floorZ = Int(floor(bottom + select(isHole, Float(0.0f), cone * 0.62f)));
        Int roofZ = min(Int(floor(roof - cone)), caveTop);
        Int wallRoof = room.wallRoof;
        if (k == kUpper) {
            const Bool isShaftHere = isShaft && isOpen;
            roofZ = select(isShaftHere, surface + 1, roofZ);
            wallRoof = select(isShaftHere, surface + 1, wallRoof);
        }
        if (k == kUpper || k == kMiddle) {
            const Float middle = room.middle;
            p.if_(isOpen && room.fungus > 0.5f, [&] {
                growMushrooms(p, middle, min(roof - bottom, rock + 24.0f),
                              room.evenBottom - static_cast<float>(kind.lake), room.fungus, mushroomLow,
                              mushroomHigh);
            });
        }
        p.set(s.floor, floorZ);
        p.set(s.roof, roofZ);
        p.set(s.wallFloor, static_cast<Int>(room.wallFloor));
        p.set(s.wallRoof, wallRoof);
        p.set(s.lake, static_cast<Int>(room.lake));
        p.set(s.wall, static_cast<Block>(room.wall));
        p.set(s.ground, static_cast<Block>(room.ground));
        p.set(s.pool, static_cast<Block>(room.pool));
        isHoleAbove = isHole && isOpen;
        ceiling = select(isOpen && !isHole, bottom - 5.0f, Float(-kFar));
        if (kind.lakeFloor != kNoLake)
            ceiling = min(ceiling,
                          select(isWet, Float(static_cast<float>(kind.lakeFloor - kSealed)), Float(-kFar)));
    }
    p.set(caves.mushroomLow, static_cast<Int>(mushroomLow));
    p.set(caves.mushroomHigh, static_cast<Int>(mushroomHigh));

    // In limestone a river runs below each stream.
    constexpr float kBelow = 34.0f, kHalfWidth = 4.5f, kBank = 9.0f, kSealWidth = 13.0f;
    const Float karst = min(c.limestone, smoothstep(0.02f, 0.06f, p.read(f.land))) *
                        smoothstep(0.02f, 0.0f, p.read(f.volcanic));
    Var<Int> riverFloor = p.var(Int(-kNowhere)), riverRoof = p.var(Int(kNowhere)),
             riverTop = p.var(Int(kNowhere)), riverSeal = p.var(Int(-kNowhere));
    const Float away = p.read(f.fromStream);
    p.if_(karst > 0.35f && away < kSealWidth, [&] {
        const Float wide = smoothstep(0.35f, 0.6f, karst);
        const Float level = floor(p.read(f.streamLevel) - kBelow);
        const Float bends = p.perlin2D("river cave banks", 12, {.5f, 1.0f}) * 1.2f;
        const Float across = away * (1.0f / kHalfWidth);
        const Float bed = select(
            across < 1.0f, level - 1.0f - rounded(1.0f - clamp(across, 0.0f, 1.0f)) * 3.0f, level + 2.0f);
        const Float high =
            level + 3.0f +
            (12.0f + bends * 3.0f) * rounded(clamp((kBank + bends - away) * (1.0f / kBank), 0.0f, 1.0f));
        const Bool isOpen = away < (kBank + bends) * wide;
        riverSeal = Int(level) - 8;
        riverTop = Int(level);
        riverFloor = select(isOpen, Int(floor(bed)), static_cast<Int>(riverFloor));
        riverRoof = select(isOpen, min(Int(floor(high)), caveTop), static_cast<Int>(riverRoof));
    });
    p.set(caves.riverFloor, static_cast<Int>(riverFloor));
    p.set(caves.riverRoof, static_cast<Int>(riverRoof));
    p.set(caves.riverTop, static_cast<Int>(riverTop));
    p.set(caves.riverSeal, static_cast<Int>(riverSeal));
}

Block withCaves(Pass& p, const Fields& f, Block rock) {
    const CaveFields& caves = *f.caves;
    const Int z = p.z();
    Var<Block> block = p.var(rock), liquid = p.var(p.block("air"));
    Var<Bool> isOpen = p.var(Bool(false)), isLake = p.var(Bool(false)), isRoom = p.var(Bool(false));
    const Int bend = Int(bendOfStrata(p) * 6.0f + 128.0f);  // of layers with lumps of crystal
    for (int k = 0; k < kStoreys; ++k) {
        const Storey& s = caves.storeys[k];
        if (kKinds[k].lake != kNoLake) {
            const int from = k == kDeep ? p.heights().bottom : kKinds[k].lakeFloor - kSealed;
            p.if_(z <= kKinds[k].lake && z >= from, [&] {
                const Bool isIn = z <= p.read(s.lake);
                // Tunnels end at the lakes of storeys; between water and lava of the deep, too.
                isLake = k == kDeep ? !isIn : isIn;
                liquid = select(isIn, p.read(s.pool), static_cast<Block>(liquid));
                if (k != kDeep) {
                    const Bool isTop = z == kKinds[k].lake && p.read(s.ground) == p.block("ice");
                    liquid = select(isIn && isTop, p.block("ice"), static_cast<Block>(liquid));
                }
            });
        }
        p.if_(z > p.read(s.wallFloor) && z < p.read(s.wallRoof), [&] {
            isOpen = isOpen || (z > p.read(s.floor) && z < p.read(s.roof));
            isRoom = isRoom || p.read(s.floor) < -kNowhere;
            const Block wall = p.read(s.wall);
            const Block lumps = select(((z + bend) & 31) < 13, p.block("crystal_rock"), rock);
            block = multiSelect(
                {{z <= p.read(s.floor), p.read(s.ground)}, {wall == p.block("crystal"), lumps}}, wall);
        });
    }
    p.if_(z > p.heights().bottom + 2 && z < p.read(f.caveTop) && !isLake && !isRoom, [&] {
        const Float where = cavePlaces(p);
        p.if_(where > -0.05f, [&] { isOpen = isOpen || landforms::isTunnel(p, where); });
    });
    p.if_(z > p.read(caves.riverSeal) && z <= p.read(caves.riverTop) + 1, [&] {
        isOpen = Bool(false);
        liquid = select(z <= p.read(caves.riverTop), p.block("water"), static_cast<Block>(liquid));
    });
    p.if_(z > p.read(caves.riverFloor) && z < p.read(caves.riverRoof), [&] { isOpen = Bool(true); });
    p.if_(isOpen, [&] {
        const Int low = p.read(caves.mushroomLow), high = p.read(caves.mushroomHigh);
        const Bool isMushroom = z >= low && z <= high, isStem = high - low > 30 && z < high - 2;
        const Bool isInAir = static_cast<Block>(liquid) == p.block("air");
        block = select(isMushroom && (isStem || isInAir),
                       select(isStem, p.block("mushroom_stem"), p.block("mushroom_cap")),
                       static_cast<Block>(liquid));
    });
    return block;
}

Block withOre(Pass& p, const Fields& f, Block rock) {
    const Int z = p.z();
    Var<Block> block = p.var(rock);
    const Float vein = abs(p.perlin2D("veins", 40, {.35f, .6f, 1.0f}));
    p.if_(vein < 0.06f && z < 420, [&] {
        const Float lumps = p.perlin3D("ore", 5, {.7f, 1.0f});
        const Float kinds = p.perlin2D("kinds of ore", 256, {.5f, 1.0f});
        const Block rockHere = p.read(f.rock);
        const Block ore = multiSelect(
            {{rockHere == p.block("basalt"), p.block("glowing_ore")},
             {z < -240, select(kinds > 0.0f, p.block("glowing_ore"), p.block("gold_ore"))},
             {z < -90, select(kinds > 0.35f, p.block("gold_ore"), p.block("iron_ore"))},
             {rockHere == p.block("red_sandstone") || kinds > 0.3f, p.block("copper_ore")},
             {rockHere == p.block("sandstone") || rockHere == p.block("limestone") || kinds < -0.3f,
              p.block("coal_ore")}},
            p.block("iron_ore"));
        block = select(lumps + vein * -4.0f > 0.36f, ore, static_cast<Block>(block));
    });
    return block;
}

void caveLifePass(Pass& p, const Fields& f) {
    Var<Block> block = p.var(p.blockHere());
    p.if_(p.z() < p.read(f.caveTop) && p.z() <= p.read(f.surface) && p.blockHere() == p.block("air"), [&] {
        const Block below = p.blockInColumn(p.z() - 1);
        const auto isOn = [&](const char* name) { return below == p.block(name); };
        const Bool isFloor = below != p.block("air") && below != p.block("water") && below != p.block("lava");
        const Bool isMoss = isOn("moss") || isOn("mud"), isDruse = isOn("crystal_rock");
        const Bool isCap = isOn("mushroom_cap");
        const Bool isBare = isOn("ice") || isOn("snow") || isOn("basalt");
        const Float chance = p.random3D("cave life", p.x(), p.y(), p.z());
        const Float glowing =
            multiSelect({{isCap, Float(0.3f)}, {isMoss, Float(0.1f)}, {isBare, Float(0.0f)}}, Float(0.014f));
        const Float brown = select(isMoss, Float(0.10f), select(isBare, Float(0.0f), Float(0.012f)));
        const Float crystals =
            select(isDruse, Float(0.3f), select(p.z() < -40 && !isBare, Float(0.006f), Float(0.0f)));
        const Block grown = multiSelect({{chance < crystals, p.block("crystal")},
                                         {chance < crystals + glowing, p.block("glowing_mushroom")},
                                         {chance < crystals + glowing + brown, p.block("brown_mushroom")}},
                                        p.block("air"));
        block = select(isFloor, grown, static_cast<Block>(block));
    });
    p.setBlock(block);
}

}  // namespace terrane::gen::wilderness
