---@meta
-- Everything that generator scripts can use, for editors that read LuaCATS annotations (lua-language-server). The
-- program does not read this file. See also docs/lua.md.

---A 32-bit integer at each column or voxel. Lua integers are converted.
---@class Int
---@operator add(Int|integer): Int
---@operator sub(Int|integer): Int
---@operator mul(Int|integer): Int
---@operator idiv(Int|integer): Int
---@operator mod(Int|integer): Int
---@operator unm: Int
---@operator band(Int|integer): Int
---@operator bor(Int|integer): Int
---@operator bxor(Int|integer): Int
---@operator bnot: Int
---@operator shl(Int|integer): Int
---@operator shr(Int|integer): Int

---A 32-bit float at each column or voxel. Lua numbers are converted.
---@class Float
---@operator add(Float|number): Float
---@operator sub(Float|number): Float
---@operator mul(Float|number): Float
---@operator div(Float|number): Float
---@operator pow(Float|number): Float
---@operator unm: Float

---True or false at each column or voxel. `&` is and, `|` is or, `~` is not.
---@class Bool
---@operator band(Bool|boolean): Bool
---@operator bor(Bool|boolean): Bool
---@operator bnot: Bool

---A block at each column or voxel. Names of blocks are converted.
---@class Block

---@class Vec2
---@field x Float
---@field y Float
---@operator add(Vec2): Vec2
---@operator sub(Vec2): Vec2
---@operator mul(Float|number): Vec2
---@operator unm: Vec2

---@class Vec3
---@field x Float
---@field y Float
---@field z Float
---@operator add(Vec3): Vec3
---@operator sub(Vec3): Vec3
---@operator mul(Float|number): Vec3
---@operator unm: Vec3

---@class IVec2
---@field x Int
---@field y Int
---@operator add(IVec2): IVec2
---@operator sub(IVec2): IVec2

---@class IVec3
---@field x Int
---@field y Int
---@field z Int

---Comparisons as methods of all expressions: Lua's own operators cannot return expressions.
---@class Expression
local Expression = {}

---Whether it is less than another.
---@param other any
---@return Bool
function Expression:lt(other) end

---Whether it is at most another.
---@param other any
---@return Bool
function Expression:le(other) end

---Whether it is greater than another.
---@param other any
---@return Bool
function Expression:gt(other) end

---Whether it is at least another.
---@param other any
---@return Bool
function Expression:ge(other) end

---Whether it equals another; blocks too.
---@param other any
---@return Bool
function Expression:eq(other) end

---Whether it differs from another; blocks too.
---@param other any
---@return Bool
function Expression:ne(other) end

---A value per column that one pass writes and later passes read.
---@class Field

---Rivers, lakes and valleys, from g:drainage.
---@class Drainage

---A value that changes while a pass is written.
---@class Variable
---@field value any  -- current value; assignments inside if_ take effect where the condition is true
local Variable = {}

---Declares the generator; the global `g` is the only instance.
---@class Generator
---@field step integer  -- blocks from one column to the next: 1, 2, 4, … by level
---@field bottom integer  -- the lowest layer of the world
---@field top integer  -- the layer above its highest one
local Generator = {}

---Declares the heights of worlds that do not name their own: multiples of 16 within -2048…2048.
---@param bottom integer
---@param top integer
function Generator:heights(bottom, top) end

---Declares a field.
---@param name string
---@param type "bool"|"int"|"float"|"block"
---@return Field
function Generator:field(name, type) end

---A pass that computes each column once.
---@param name string
---@param body fun(p: Pass)
function Generator:pass2D(name, body) end

---A pass that computes each voxel. The last pass is one.
---@param name string
---@param body fun(p: Pass)
function Generator:pass3D(name, body) end

---Makes a field of packColor() the color of grass and leaves.
---@param colors Field
function Generator:tint(colors) end

---@class DrainageSpec
---@field spacing? integer  -- blocks from node to node: a power of two, 64…1024
---@field seaLevel? number
---@field minFlow? integer  -- nodes upstream that make a river, 1…64
---@field halfWidth? number
---@field maxHalfWidth? number
---@field reach? number  -- blocks, up to the spacing
---@field bend? number  -- 0…0.25
---@field lakeDepth? number
---@field lakeNodes? integer
---@field maxCut? number

---Declares a map of rivers and lakes over the heights that `height` returns. With `gradient` the map has valleys.
---@param name string
---@param spec DrainageSpec
---@param height fun(p: Pass): Float
---@param gradient? fun(p: Pass): Float  -- how steep a stream of one node is, blocks per block, 0 or more
---@return Drainage
function Generator:drainage(name, spec, height, gradient) end

---@class Shape
---@field name string
---@field blocks { name: string, rank: integer? }[]  -- rank 0…3: the higher one stays where shapes meet
---@field voxels integer[][]  -- {x, y, z, number of the block from 1}

---A shape that passes can stamp; its number.
---@param shape Shape
---@return integer
function Generator:shape(shape) end

---@class TreeKind
---@field first integer
---@field count integer
---@field cover number  -- blocks seen from above
---@field height number
---@field wood string
---@field leaves string

---The kinds of trees: oak, oldOak, birch, spruce, pine, larch, acacia, willow, palm, baobab, cypress, deadTree, bush,
---boulder, fallenLog, giantMushroom.
---@return table<string, TreeKind>
function Generator:trees() end

---A pass while it is written.
---@class Pass
---@field x Int  -- block coordinates
---@field y Int
---@field z Int  -- 3D passes
---@field step integer  -- blocks from one column to the next
local Pass = {}

---A field of an earlier pass.
---@param field Field
---@return any
function Pass:read(field) end

---A field of another column, up to 16 blocks away.
---@param field Field
---@param dx Int|integer|IVec2
---@param dy? Int|integer
---@return any
function Pass:readAt(field, dx, dy) end

---The gradient of a Float field, per block.
---@param field Field
---@return Vec2
function Pass:slope(field) end

---The lowest value of a Float field in the four columns beside.
---@param field Field
---@return Float
function Pass:lowestBeside(field) end

---A field of Float at an offset of any fraction of a block.
---@param field Field
---@param offset Vec2
---@return Float
function Pass:readBetween(field, offset) end

---Writes a field from a 2D pass.
---@param field Field
---@param value any
function Pass:set(field, value) end

---Writes a field from a 3D pass: the value at height z of the column.
---@param field Field
---@param z Int|integer
---@param value any
function Pass:setAt(field, z, value) end

---A block by name.
---@param name string
---@return Block
function Pass:block(name) end

---The block that the 3D pass before put here.
---@return Block
function Pass:blockHere() end

---The block of the 3D pass before at height z of this column.
---@param z Int|integer
---@return Block
function Pass:blockInColumn(z) end

---The block of the 3D pass before in another column, up to 16 blocks away.
---@param dx Int|integer|IVec2
---@param dy Int|integer
---@param z? Int|integer
---@return Block
function Pass:blockAt(dx, dy, z) end

---This pass's block.
---@param block Block|string
function Pass:setBlock(block) end

---The block that shapes put here, air where none.
---@param shape Field  -- int: number of a shape with its foot in the column, or another number
---@param base Field  -- int: height of the foot
---@return Block
function Pass:stamp(shape, base) end

---A variable of the type of its first value: 1 is Int, 1.0 is Float, true is Bool, "stone" is Block.
---@param initial any
---@return Variable
function Pass:var(initial) end

---Computes a side only where the condition asks for it.
---@param condition Bool|boolean
---@param body fun()
---@param otherwise? fun()
function Pass:if_(condition, body, otherwise) end

---Repeats while the condition holds, 1,024 times at most.
---@param condition fun(): Bool
---@param body fun()
function Pass:while_(condition, body) end

---Perlin noise over lattices of size, 2 size, 4 size… blocks with these weights.
---@param name string
---@param size integer
---@param weights number[]
---@return Float
function Pass:perlin2D(name, size, weights) end

---The same in space.
---@param name string
---@param size integer
---@param weights number[]
---@return Float
function Pass:perlin3D(name, size, weights) end

---The noise, with faded octaves replaced by a random number for each column.
---@param name string
---@param size integer
---@param weights number[]
---@return Float
function Pass:perlin2DWithGrain(name, size, weights) end

---The gradient of the noise, per block.
---@param name string
---@param size integer
---@param weights number[]
---@return Vec2
function Pass:perlin2DGradient(name, size, weights) end

---The same in space.
---@param name string
---@param size integer
---@param weights number[]
---@return Vec3
function Pass:perlin3DGradient(name, size, weights) end

---Noise on a lattice of triangles: no directions show.
---@param name string
---@param size integer
---@param weights number[]
---@return Float
function Pass:simplex2D(name, size, weights) end

---The same in space; slow.
---@param name string
---@param size integer
---@param weights number[]
---@return Float
function Pass:simplex3D(name, size, weights) end

---A random number for each column, mean 0, deviation 1.
---@param name string
---@return Float
function Pass:grain(name) end

---A random pair for each column.
---@param name string
---@return Vec2
function Pass:grain2D(name) end

---Waves about `size` blocks long whose phase grows along a direction of length 1.
---@param name string
---@param size integer
---@param direction Vec2
---@return { cosine: Float, sine: Float }
function Pass:stripes2D(name, size, direction) end

---The nearest of points, 1…maxPoints (up to 4) in each cell.
---@param name string
---@param size integer
---@param maxPoints integer
---@return { distance: Float, ratio: Float, offset: IVec2 }
function Pass:voronoi2D(name, size, maxPoints) end

---The same in space; a larger exponent, 2…8, makes cells of boxes.
---@param name string
---@param size integer
---@param maxPoints integer
---@param exponent? integer
---@return { distance: Float, ratio: Float, offset: IVec3 }
function Pass:voronoi3D(name, size, maxPoints, exponent) end

---The position of the column relative to rivers and lakes.
---@param map Drainage
---@return { distance: Float, halfWidth: Float, level: Float, flow: Float, lakeDistance: Float, lakeLevel: Float, fall: Float }
function Pass:drainage(map) end

---The streams around the column, of a map with gradients: how far they are, how high, and how large.
---@param map Drainage
---@return { distance: Float, level: Float, flow: Float }
function Pass:valleys(map) end

---A number in [0, 1) by position; here where none is given.
---@param name string
---@param x? Int|integer
---@param y? Int|integer
---@return Float
function Pass:random2D(name, x, y) end

---The same in space.
---@param name string
---@param x? Int|integer
---@param y? Int|integer
---@param z? Int|integer
---@return Float
function Pass:random3D(name, x, y, z) end

---True with a probability.
---@param name string
---@param probability Float|number
---@param x? Int|integer
---@param y? Int|integer
---@return Bool
function Pass:randomBool2D(name, probability, x, y) end

---The same in space.
---@param name string
---@param probability Float|number
---@param x? Int|integer
---@param y? Int|integer
---@param z? Int|integer
---@return Bool
function Pass:randomBool3D(name, probability, x, y, z) end

---Points that stand apart from each other, one in each square of `spacing` blocks.
---@param name string
---@param spacing integer  -- 1…1024
---@param minDistance integer  -- 1…spacing
---@return { isHere: Bool, at: IVec2, hash: Int }
function Pass:scatter(name, spacing, minDistance) end

---Gullies and ridges for a height field of this slope.
---@param name string
---@param slope Vec2
---@param strength Float|number
---@param erosion? { size: integer?, octaves: integer?, depth: number?, fullSlope: number?, gain: number? }
---@return { height: Float, ridge: Float }
function Pass:erode(name, slope, strength, erosion) end

---@type Generator
g = {}

---The second value where the condition holds, else the third; both are computed.
---@param condition Bool|boolean
---@param a any
---@param b any
---@return any
function select(condition, a, b) end

---The value of the first case {condition, value} whose condition holds.
---@param cases any[][]
---@param otherwise any
---@return any
function multiSelect(cases, otherwise) end

---The least.
---@param a any
---@param b any
---@param ... any
---@return any
function min(a, b, ...) end

---The greatest.
---@param a any
---@param b any
---@param ... any
---@return any
function max(a, b, ...) end

---Between low and high.
---@param v any
---@param low any
---@param high any
---@return any
function clamp(v, low, high) end

---Without its sign.
---@param v any
---@return any
function abs(v) end

---The whole number at or below.
---@param v Float|number
---@return Float
function floor(v) end

---The whole number at or above.
---@param v Float|number
---@return Float
function ceil(v) end

---The nearest whole number; halves upward.
---@param v Float|number
---@return Float
function round(v) end

---@param v Float|number
---@return Float
function sqrt(v) end

---@param v Float|number
---@return Float
function exp2(v) end

---@param v Float|number
---@return Float
function log2(v) end

---@param v Float|number  -- 0 or more
---@param exponent Float|number
---@return Float
function pow(v, exponent) end

---@param radians Float|number
---@return Float
function sin(radians) end

---@param radians Float|number
---@return Float
function cos(radians) end

---From a to b as t goes from 0 to 1.
---@param a Float|number
---@param b Float|number
---@param t Float|number
---@return Float
function lerp(a, b, t) end

---0 below low, 1 above high, a smooth cubic between.
---@param low Float|number
---@param high Float|number
---@param v Float|number
---@return Float
function smoothstep(low, high, v) end

---Division rounded toward minus infinity; the divisor is 1 or more. The same as a // b.
---@param a Int|integer
---@param b Int|integer
---@return Int
function floorDivide(a, b) end

---The remainder of floorDivide(), 0…b − 1. The same as a % b.
---@param a Int|integer
---@param b Int|integer
---@return Int
function floorModulo(a, b) end

---A color of sRGB values 0…1 as an Int, for tints.
---@param red Float|number
---@param green Float|number
---@param blue Float|number
---@return Int
function packColor(red, green, blue) end

---The bits of a Float.
---@param v Float|number
---@return Int
function floatBits(v) end

---And back.
---@param bits Int|integer
---@return Float
function bitsFloat(bits) end

---Toward zero.
---@param v Float|Int|number
---@return Int
function int(v) end

---@param v Int|Float|number
---@return Float
function float(v) end

---@param x Float|number
---@param y Float|number
---@return Vec2
function vec2(x, y) end

---@param x Float|number
---@param y Float|number
---@param z Float|number
---@return Vec3
function vec3(x, y, z) end

---@param x Int|integer
---@param y Int|integer
---@return IVec2
function ivec2(x, y) end

---@param a Vec2|Vec3
---@param b Vec2|Vec3
---@return Float
function dot(a, b) end

---@param v Vec2|Vec3
---@return Float
function length(v) end

---The standard deviation of a noise's octaves that fade at a step.
---@param weights number[]
---@param size integer
---@param step integer
---@return number
function lostDeviation(weights, size, step) end

---The same for the noise's slope along an axis.
---@param weights number[]
---@param size integer
---@param step integer
---@return number
function lostSlope(weights, size, step) end

---The share, 0…1, of cells of `size` blocks that remains at a step.
---@param size integer
---@param step integer
---@return number
function shareLeft(size, step) end

---One of a kind's shapes, chosen by a hash such as those of p:scatter's points.
---@param kind TreeKind
---@param hash Int|integer
---@return Int
function shapeOf(kind, hash) end

---Ends the script with a message.
---@param message string
---@param level? integer
function error(message, level) end

---@param list any[]
function ipairs(list) end

---Iterates over a table in the order of its keys: numbers, strings, booleans.
---@param t table
function pairs(t) end

---@param v any
---@param base? integer
---@return number?
function tonumber(v, base) end

---@param v any
---@return string
function tostring(v) end

---Also "Float", "Int", "Block", …
---@param v any
---@return string
function type(v) end

---Prints a line to the log while level 0 is recorded, at most 20.
---@param ... any
function print(...) end

---@param condition any
---@param message? string
function assert(condition, message) end

---@class stringlib
string = {}
function string.byte(s, i, j) end
function string.char(...) end
---Finds a text in another, from `init` on; no patterns.
---@param s string
---@param text string
---@param init? integer
---@return integer?, integer?
function string.find(s, text, init) end
function string.format(pattern, ...) end
function string.len(s) end
function string.lower(s) end
function string.rep(s, times, between) end
function string.reverse(s) end
function string.sub(s, i, j) end
function string.upper(s) end

---@class tablelib
table = {}
function table.concat(list, between) end
function table.insert(list, position, value) end
function table.remove(list, position) end
---Stable: equal items keep their order.
---@param list any[]
---@param isBefore? fun(a: any, b: any): boolean
function table.sort(list, isBefore) end
function table.unpack(list) end

---@class mathlib
---@field huge number
---@field maxinteger integer
---@field mininteger integer
---@field pi number
math = {}
function math.abs(v) end
function math.ceil(v) end
function math.floor(v) end
function math.fmod(a, b) end
function math.max(v, ...) end
function math.min(v, ...) end
function math.sqrt(v) end
function math.tointeger(v) end
function math.type(v) end
function math.ult(a, b) end
