-- 9. Rivers: a drainage map follows the wide shape of the land down to the sea; the land then goes to the rivers' banks.

local seaLevel <const> = 80
local height, water = g:field("height", "float"), g:field("water", "float")

-- The terrain without details, which rivers follow.
local function wideLand(p)
    return 104 + p:perlin2D("wide land", 128, {7, 14, 20, 26, 34})
end

local rivers = g:drainage("rivers", {spacing = 128, seaLevel = seaLevel, minFlow = 4, halfWidth = 2, maxHalfWidth = 10}, wideLand)

g:pass2D("land", function(p)
    local s = p:drainage(rivers)
    local land = wideLand(p) + p:perlin2D("small hills", 16, {1, 2, 4})
    -- Lakes first, so that a river keeps its banks where it meets one. Noise bends their round shores.
    local shore = s.lakeDistance + p:perlin2D("shores", 16, {3, 6})
    local bank = s.distance - s.halfWidth  -- below 0 in the river
    local ground = lerp(s.lakeLevel + 1, land, smoothstep(0, 60, shore))
    ground = lerp(s.level + 1, ground, smoothstep(0, 55, bank))
    ground = select(land:lt(seaLevel), min(land, ground), ground)  -- no banks in the sea
    local across = min(s.distance / max(s.halfWidth, 1), 1)
    local riverBed = s.level - 1 - (1 - across * across) * s.halfWidth * 0.3
    local lakeBed = s.lakeLevel - 1 + max(shore, -40) * 0.2
    local isLake, isRiver = shore:lt(0), bank:lt(0)
    p:set(height, multiSelect({{isLake, lakeBed}, {isRiver, min(ground, riverBed)}}, ground))
    local level = multiSelect({{isLake, s.lakeLevel}, {isRiver, s.level}}, seaLevel)
    p:set(water, floor(max(level, seaLevel)))
end)

g:pass3D("ground", function(p)
    local ground, level, z = floor(p:read(height)), p:read(water), float(p.z)
    local depth = ground - z
    local steepness = length(p:slope(height))
    local isWet = ground:lt(level + 1) & ground:gt(level - 30)
    local bed = multiSelect({{p:perlin2D("beds", 12, {1}):gt(0.2), "gravel"}, {ground:lt(level - 4), "clay"}}, "sand")
    local top = multiSelect({{isWet, bed}, {steepness:gt(1.1), "stone"}, {ground:gt(158), "snow"}}, "grass")
    local soil = select(isWet, "gravel", "dirt")
    local open = select(z:le(level), "water", "air")
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}, {depth:lt(4), soil}}, "stone"))
end)

if g.step <= 2 then
    g:pass3D("plants", function(p)
        local below = p:blockInColumn(p.z - 1)
        p:if_(p:blockHere():eq("air") & p.z:gt(2), function()
            local nearWater = float(p.z):lt(p:read(water) + 3)
            local chance = p:random2D("plant")
            p:setBlock(multiSelect({
                {below:eq("grass") & nearWater & chance:lt(0.3), "reeds"},
                {below:eq("grass") & chance:lt(0.12), "grass_tuft"},
                {below:eq("grass") & chance:gt(0.99), "blue_orchid"},
            }, "air"))
        end)
    end)
end
