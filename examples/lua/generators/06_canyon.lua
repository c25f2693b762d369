-- 6. Canyon: a plateau of colored layers, cut in steps down to a river.

local waterLevel <const> = 66
local height = g:field("height", "float")

-- Rounds heights to steps of `size` blocks with steep walls between them.
local function terraces(h, size)
    local level = floor(h / size)
    local rest = h / size - level
    return (level + smoothstep(0.55, 0.95, rest)) * size
end

g:pass2D("land", function(p)
    -- Zero lines of a noise wind through the land; the distance to them is about |noise| / slope.
    local course = p:perlin2D("canyons", 128, {0.25, 1})
    local away = abs(course) * 240 + p:perlin2D("walls", 16, {1.5, 3, 4})
    local plateau = 132 + p:perlin2D("plateau", 96, {3, 5, 9})
    -- Side valleys make the rim ragged.
    local raw = 58 + smoothstep(0, 110, away) * (plateau - 58) + p:perlin2D("side valleys", 24, {2, 5})
    local stepped = terraces(raw + p:perlin2D("steps", 48, {3}), 13)
    p:set(height, lerp(raw, stepped, smoothstep(waterLevel, waterLevel + 10, raw) * 0.85))
end)

-- Bands of rock follow the height, bent a little, as they were laid down.
local function rockAt(p)
    local bend = p:perlin2D("bends", 128, {2, 4})
    local layer = floorModulo(p.z + int(floor(bend)), 32)
    return multiSelect({
        {layer:lt(5), "red_sandstone"},
        {layer:lt(7), "sandstone"},
        {layer:lt(14), "terracotta"},
        {layer:lt(16), "limestone"},
        {layer:lt(24), "red_sandstone"},
        {layer:lt(25), "sandstone"},
    }, "terracotta")
end

g:pass3D("ground", function(p)
    local ground, z = p:read(height), float(p.z)
    local depth = ground - z
    local steepness = length(p:slope(height))
    local isGentle = steepness:lt(0.7)
    local top = multiSelect({
        {ground:lt(waterLevel + 1.5), "sand"},
        {isGentle & ground:gt(122) & p:perlin2D("scrub", 24, {1}):gt(-0.1), "grass"},
        {isGentle, "red_sand"},
    }, rockAt(p))
    local open = select(p.z:le(waterLevel), "water", "air")
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}}, rockAt(p)))
end)

if g.step <= 2 then
    g:pass3D("plants", function(p)
        local below = p:blockInColumn(p.z - 1)
        p:if_(p:blockHere():eq("air") & p.z:gt(2), function()
            local chance = p:random2D("plant")
            p:setBlock(multiSelect({
                {below:eq("grass") & chance:lt(0.2), "savanna_grass"},
                {below:eq("red_sand") & chance:lt(0.01), "dead_bush"},
                {below:eq("red_sand") & chance:gt(0.998), "cactus"},
            }, "air"))
        end)
    end)
end
