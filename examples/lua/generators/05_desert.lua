-- 5. Desert: dunes that run across the wind, rocks that stand out of the sand, and oases.

local waterLevel <const> = 70
local height = g:field("height", "float")
local rock = g:field("rock", "float")  -- height of the rock under the sand
local oasis = g:field("oasis", "float")

-- A wave of 48 blocks, bent by noise, gentle towards the wind and steep behind the crest.
local function dunes(p)
    local turn = p:perlin2D("wind", 512, {0.5})
    local wave = p:stripes2D("dunes", 48, vec2(cos(turn), sin(turn)))
    local crest = wave.cosine * 0.5 + 0.5
    return crest * crest * 8 + wave.sine * 1.5 + p:perlin2D("ripples", 8, {0.3, 0.4})
end

g:pass2D("land", function(p)
    local wide = p:perlin2D("wide land", 256, {6, 9})
    local water = smoothstep(0.52, 0.75, p:perlin2D("oases", 160, {1}))
    local sea = p:perlin2D("sand seas", 160, {0.5, 1})
    local sand = 84 + wide + dunes(p) * (0.35 + smoothstep(-0.3, 0.5, sea)) * (1 - water)
    p:set(height, lerp(sand, waterLevel - 3, water))
    p:set(oasis, water)
    -- Table mountains: noise pressed against a ceiling.
    local tables = smoothstep(0.32, 0.44, p:perlin2D("tables", 96, {0.2, 0.4, 0.8}))
    p:set(rock, 74 + wide + tables * (26 + p:perlin2D("tops", 24, {2})) - water * 30)
end)

g:pass3D("ground", function(p)
    local ground, stone, z = p:read(height), p:read(rock), float(p.z)
    local layer = floorModulo(p.z + int(p:perlin2D("layers", 64, {4}) + 8), 9)
    local bands = multiSelect({{layer:lt(2), "red_sandstone"}, {layer:lt(3), "terracotta"}}, "sandstone")
    local isOasis = p:read(oasis):gt(0.05)
    local top = select(isOasis & ground:lt(waterLevel + 7) & ground:gt(waterLevel - 0.5), "grass", "sand")
    p:setBlock(multiSelect({
        {z:le(stone), bands},
        {z:le(ground - 1), "sand"},
        {z:le(ground), top},
        {isOasis & p.z:le(waterLevel), "water"},
    }, "air"))
end)

if g.step <= 2 then
    g:pass3D("plants", function(p)
        local below = p:blockInColumn(p.z - 1)
        p:if_(p:blockHere():eq("air") & p.z:gt(2), function()
            local chance = p:random2D("plant")
            p:setBlock(multiSelect({
                {below:eq("sand") & chance:lt(0.0012), "cactus"},
                {below:eq("cactus") & p:randomBool3D("taller", 0.6), "cactus"},
                {below:eq("sand") & chance:gt(0.996), "dead_bush"},
                {below:eq("grass") & chance:lt(0.25), "savanna_grass"},
                {below:eq("grass") & chance:gt(0.9), "reeds"},
            }, "air"))
        end)
    end)
end
