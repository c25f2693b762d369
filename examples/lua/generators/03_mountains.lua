-- 3. Mountains: ridges from noise, gullies that an erosion filter cuts into them, and a cover that follows the slope.

local seaLevel <const> = 80
local rough = g:field("rough height", "float")
local height = g:field("height", "float")
local ridge = g:field("ridge", "float")
local cover = g:field("cover", "block")

g:pass2D("relief", function(p)
    local where = smoothstep(-0.35, 0.35, p:perlin2D("ranges", 384, {1, 0.5}))
    -- Noise folded at 0 has its crests there. The small number under the root rounds them: no knife edges.
    local fold = p:perlin2D("folds", 128, {0.25, 0.5, 1})
    local crest = 1 - sqrt(fold * fold + 0.004)
    local hills = p:perlin2D("hills", 32, {1, 3, 6})
    p:set(rough, 88 + hills + where * (crest * crest * 125 - 24))
end)

g:pass2D("erosion", function(p)
    local strength = smoothstep(95, 125, p:read(rough))
    local eroded = p:erode("gullies", p:slope(rough), strength, {size = 96, octaves = 5, depth = 0.2})
    p:set(height, p:read(rough) + eroded.height)
    p:set(ridge, eroded.ridge)
end)

-- Steep land is bare. Snow covers high land, first the ridges.
g:pass2D("cover", function(p)
    local ground, steepness = p:read(height), length(p:slope(height))
    local spots = p:perlin2DWithGrain("spots", 8, {0.4, 0.6})
    local snowLine = 150 - p:read(ridge) * 8 + spots * 9
    local treeLine = 128 + spots * 10
    p:set(cover, multiSelect({
        {ground:lt(seaLevel + 1.5), "gravel"},
        {steepness:gt(1.35 + spots * 0.3), "stone"},
        {ground:gt(snowLine), "snow"},
        {steepness:gt(0.95 + spots * 0.3), "stone"},
        {ground:gt(treeLine), select(spots:gt(0.2), "gravel", "moss")},
    }, "grass"))
end)

g:pass3D("ground", function(p)
    local depth = p:read(height) - float(p.z)
    local top = p:read(cover)
    local soil = select(top:eq("grass"), "dirt", top)
    local open = select(p.z:le(seaLevel), "water", "air")
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}, {depth:lt(3), soil}}, "stone"))
end)
