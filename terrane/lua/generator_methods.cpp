// Methods of the generator: fields, passes, tint, shapes, trees, drainage maps.

#include "terrane/gen/generators/trees/trees.h"
#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

using gen::Float;

// Also inside of a drainage map's function, whose builder does not know what is declared meanwhile.
void requireNoPass(GraphCall& c) {
    if (c.recording.pass != nullptr) fail("{}: not inside of a pass", c.function);
}

std::string nameOfPart(GraphCall& c, int argument) {
    const std::string_view name = c.text(argument);
    if (name.empty() || name.size() > kMaxNameBytes)
        fail("{}: names have 1 to {} bytes", c.function, kMaxNameBytes);
    return std::string(name);
}

int field(GraphCall& c) {
    requireNoPass(c);
    const std::string name = nameOfPart(c, 1);
    const std::string_view type = c.text(2);
    auto& fields = c.recording.fields;
    if (fields.size() == kMaxFields) fail("field: more than {} fields", kMaxFields);
    Object object{Tag::Field, 0, {}};
    if (type == "bool") {
        object.number = c.recording.builder.field<gen::Bool>(name).index;
        object.expression.kind = Kind::Bool;
    } else if (type == "int") {
        object.number = c.recording.builder.field<gen::Int>(name).index;
        object.expression.kind = Kind::Int;
    } else if (type == "float") {
        object.number = c.recording.builder.field<Float>(name).index;
        object.expression.kind = Kind::Float;
    } else if (type == "block") {
        object.number = c.recording.builder.field<gen::Block>(name).index;
        object.expression.kind = Kind::Block;
    } else {
        fail("field: expected \"bool\", \"int\", \"float\" or \"block\", got \"{}\"", type);
    }
    fields.push_back(object.expression.kind);
    pushObject(c.L, object);
    return 1;
}

// The open pass of a recording, as long as one of these lives.
class OpenPass {
  public:
    OpenPass(Recording& recording, gen::Pass& pass) : recording_(recording) {
        recording_.pass = &pass;
        ++recording_.passNumber;
        recording_.variables.clear();
    }
    ~OpenPass() { recording_.pass = nullptr; }
    OpenPass(const OpenPass&) = delete;
    OpenPass& operator=(const OpenPass&) = delete;

  private:
    Recording& recording_;
};

// Calls the script's function of a pass.
void callBody(GraphCall& c, int argument, int results) {
    luaL_checkstack(c.L, 10, "calls are nested too deeply");
    lua_pushvalue(c.L, argument);
    Object object{Tag::Pass, 0, {}};
    object.expression.pass = c.recording.passNumber;
    pushObject(c.L, object);
    lua_call(c.L, 1, results);
}

int addPass(GraphCall& c, bool is3D) {
    requireNoPass(c);
    const std::string name = nameOfPart(c, 1);
    c.function_(2);
    if (c.recording.passCount++ == kMaxPasses) fail("{}: more than {} passes", c.function, kMaxPasses);
    const auto body = [&](gen::Pass& pass) {
        const OpenPass open(c.recording, pass);
        callBody(c, 2, 0);
    };
    if (is3D) {
        c.recording.builder.pass3D(name, body);
    } else {
        c.recording.builder.pass2D(name, body);
    }
    return 0;
}

int pass2D(GraphCall& c) {
    return addPass(c, false);
}

int pass3D(GraphCall& c) {
    return addPass(c, true);
}

// Of the world, as long as nothing depends on other ones.
int heights(GraphCall& c) {
    requireNoPass(c);
    if (c.recording.readsHeights) fail("heights: called after g.bottom or g.top was read");
    const auto border = [&](int argument) {
        return c.integer(argument, world::kLowestBottom, world::kHighestTop);
    };
    c.recording.builder.declareHeights({border(1), border(2)});
    return 0;
}

int tint(GraphCall& c) {
    requireNoPass(c);
    c.recording.builder.tint(gen::Field<gen::Int>{c.field(1, Kind::Int)});
    return 0;
}

gen::DrainageSpec drainageSpec(GraphCall& c, int argument) {
    gen::DrainageSpec spec;
    readOptions(c, argument,
                {{"spacing", &spec.spacing},
                 {"seaLevel", &spec.seaLevel},
                 {"minFlow", &spec.minFlow},
                 {"halfWidth", &spec.halfWidth},
                 {"maxHalfWidth", &spec.maxHalfWidth},
                 {"reach", &spec.reach},
                 {"bend", &spec.bend},
                 {"lakeDepth", &spec.lakeDepth},
                 {"lakeNodes", &spec.lakeNodes},
                 {"maxCut", &spec.maxCut}});
    return spec;
}

int drainage(GraphCall& c) {
    requireNoPass(c);
    const std::string name = nameOfPart(c, 1);
    const gen::DrainageSpec spec = drainageSpec(c, 2);
    c.function_(3);
    if (!c.isMissing(4)) c.function_(4);
    if (c.recording.drainageCount++ == kMaxDrainages) fail("drainage: more than {} maps", kMaxDrainages);
    const auto recorded = [&](gen::Pass& pass, int argument) {
        const OpenPass open(c.recording, pass);
        callBody(c, argument, 1);
        const int result = lua_gettop(c.L);
        const bool isFloat = c.isNumber(result) ||
                             (c.expression(result) != nullptr && c.expression(result)->kind == Kind::Float);
        if (!isFloat)
            fail("drainage: its {} function must return a Float, got {}",
                 argument == 3 ? "height" : "gradient", c.described(result));
        const Float value = c.get<Float>(result);
        c.finish();
        return value;
    };
    const auto height = [&](gen::Pass& pass) { return recorded(pass, 3); };
    std::function<Float(gen::Pass&)> gradient;
    if (!c.isMissing(4)) gradient = [&](gen::Pass& pass) { return recorded(pass, 4); };
    Object object{Tag::Drainage, c.recording.builder.drainage(name, spec, height, gradient).index, {}};
    pushObject(c.L, object);
    return 1;
}

gen::ShapeBlock shapeBlock(GraphCall& c, lua_Integer number) {
    if (lua_geti(c.L, -1, number) != LUA_TTABLE)
        fail("shape: block {} is not {{name = …, rank = …}}", number);
    gen::ShapeBlock block;
    if (lua_getfield(c.L, -1, "name") != LUA_TSTRING) fail("shape: block {} has no name", number);
    block.name = c.recording.blocks.find(c.text(lua_gettop(c.L)));
    if (lua_getfield(c.L, -2, "rank") != LUA_TNIL)
        block.rank = c.integer(lua_gettop(c.L), 0, gen::kMaxShapeRank);
    lua_pop(c.L, 3);
    return block;
}

gen::ShapeVoxel shapeVoxel(GraphCall& c, lua_Integer number, std::size_t blocks) {
    if (lua_geti(c.L, -1, number) != LUA_TTABLE) fail("shape: voxel {} is not {{x, y, z, block}}", number);
    std::array<int, 4> values{};
    for (int k = 0; k < 4; ++k) {
        lua_geti(c.L, -1, k + 1);
        const int at = lua_gettop(c.L);
        values[static_cast<std::size_t>(k)] =
            k < 3 ? c.integer(at, -128, 127) : c.integer(at, 1, static_cast<int>(blocks));
        lua_pop(c.L, 1);
    }
    lua_pop(c.L, 1);
    return {static_cast<std::int8_t>(values[0]), static_cast<std::int8_t>(values[1]),
            static_cast<std::int8_t>(values[2]), static_cast<std::uint8_t>(values[3] - 1)};
}

// Pushes a list that is a member of the table and returns its length.
lua_Integer pushList(GraphCall& c, const char* key, std::size_t most) {
    if (lua_getfield(c.L, 1, key) != LUA_TTABLE) fail("shape: {}: expected a list", key);
    const lua_Integer length = c.listLength(lua_gettop(c.L));
    if (length > static_cast<lua_Integer>(most)) fail("shape: {}: more than {}", key, most);
    c.charge(40 * length);
    return length;
}

int shape(GraphCall& c) {
    constexpr std::size_t kMaxBlocks = 64;
    requireNoPass(c);
    c.table(1);
    gen::VoxelShape result;
    lua_getfield(c.L, 1, "name");
    result.name = nameOfPart(c, lua_gettop(c.L));
    const lua_Integer blocks = pushList(c, "blocks", kMaxBlocks);
    for (lua_Integer k = 1; k <= blocks; ++k) result.blocks.push_back(shapeBlock(c, k));
    const lua_Integer voxels = pushList(c, "voxels", kMaxVoxels - c.recording.voxelCount);
    for (lua_Integer k = 1; k <= voxels; ++k) result.voxels.push_back(shapeVoxel(c, k, result.blocks.size()));
    c.recording.voxelCount += result.voxels.size();
    lua_pushinteger(c.L, c.recording.builder.shape(result));
    return 1;
}

// "old oak" is trees.oldOak.
std::string keyOf(std::string_view name) {
    std::string key;
    for (std::size_t k = 0; k < name.size(); ++k) {
        if (name[k] == ' ') continue;
        const bool isStart = k > 0 && name[k - 1] == ' ';
        key += isStart ? static_cast<char>(name[k] - 'a' + 'A') : name[k];
    }
    return key;
}

void pushKind(GraphCall& c, const gen::trees::KindRecord& kind) {
    lua_createtable(c.L, 0, 6);
    c.set("first", gen::Int(kind.first));
    c.set("count", gen::Int(kind.count));
    c.set("cover", Float(kind.cover));
    c.set("height", Float(kind.height));
    for (const auto& [key, block] : {std::pair{"wood", kind.wood}, std::pair{"leaves", kind.leaves}}) {
        lua_pushlstring(c.L, block.data(), block.size());
        lua_setfield(c.L, -2, key);
    }
}

gen::trees::Kind kindOf(std::string_view key) {
    for (const gen::trees::Kind kind : gen::trees::allKinds()) {
        if (keyOf(gen::trees::nameOf(kind)) == key) return kind;
    }
    fail("trees: there is no kind \"{}\"", key);
}

std::vector<gen::trees::Kind> kindsOfList(GraphCall& c, int argument) {
    c.table(argument);
    std::vector<gen::trees::Kind> kinds;
    const lua_Integer length = c.listLength(argument);
    if (length > static_cast<lua_Integer>(gen::trees::Kind::Count))
        fail("trees: more names than there are kinds");
    for (lua_Integer k = 1; k <= length; ++k) {
        if (lua_geti(c.L, argument, k) != LUA_TSTRING) fail("trees: name {} is not a string", k);
        kinds.push_back(kindOf(c.text(lua_gettop(c.L))));
        lua_pop(c.L, 1);
    }
    return kinds;
}

int trees(GraphCall& c) {
    requireNoPass(c);
    if (c.recording.hasTrees) fail("trees: called before: keep the result of the first call");
    const std::vector<gen::trees::Kind> wanted = c.isMissing(1) ? gen::trees::allKinds() : kindsOfList(c, 1);
    c.recording.hasTrees = true;
    c.recording.budget.pauseClock();  // the first call of a process grows them
    const gen::trees::TreeKinds kinds = gen::trees::record(c.recording.builder, wanted);
    for (const gen::trees::Kind kind : wanted) {
        for (const gen::VoxelShape& grown : gen::trees::shapesOf(kind)) {
            for (const gen::ShapeBlock& block : grown.blocks) c.recording.blocks.addUsed(block.name);
        }
    }
    c.recording.budget.resumeClock();
    lua_createtable(c.L, 0, static_cast<int>(wanted.size()));
    for (const gen::trees::KindRecord& kind : kinds) {
        if (kind.count == 0) continue;
        pushKind(c, kind);
        lua_setfield(c.L, -2, keyOf(kind.name).c_str());
    }
    return 1;
}

constexpr GraphFunction kGeneratorMethods[] = {
    {"field", field}, {"pass2D", pass2D},     {"pass3D", pass3D}, {"heights", heights},
    {"tint", tint},   {"drainage", drainage}, {"shape", shape},   {"trees", trees}};

}  // namespace

std::span<const GraphFunction> generatorMethods() {
    return kGeneratorMethods;
}

}  // namespace terrane::lua
