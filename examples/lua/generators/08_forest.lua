-- 8. Forest: trees of several kinds. A 2D pass places their feet, the 3D pass reads their blocks.

local seaLevel <const> = 80
local height = g:field("height", "float")
local tree, treeBase = g:field("tree", "int"), g:field("tree base", "int")
local low, lowBase = g:field("undergrowth", "int"), g:field("undergrowth base", "int")
local grassColor = g:field("grass color", "int")
local trees = g:trees()

g:pass2D("land", function(p)
    local hills = p:perlin2D("hills", 48, {2, 5, 10})
    p:set(height, 88 + hills + smoothstep(4, 18, hills) * 14)
end)

-- Noise and a random number for each tree choose its kind, so that woods mix at their edges.
local function kindOfTree(p, point)
    local wood = p:perlin2D("woods", 128, {0.3, 1}) + (p:random2D("mix", point.at.x, point.at.y) - 0.5) * 0.5
    return multiSelect({
        {wood:lt(-0.35), shapeOf(trees.spruce, point.hash)},
        {wood:lt(-0.1), shapeOf(trees.pine, point.hash)},
        {wood:lt(0.25), shapeOf(trees.oak, point.hash)},
        {wood:lt(0.45), shapeOf(trees.birch, point.hash)},
    }, shapeOf(trees.oldOak, point.hash))
end

g:pass2D("trees", function(p)
    local ground = p:read(height)
    local isLand = ground:gt(seaLevel + 1.5) & length(p:slope(height)):lt(1)
    local clearing = p:perlin2D("clearings", 64, {0.5, 1})
    local point = p:scatter("trees", 7, 5)
    local grows = p:random2D("tree grows", point.at.x, point.at.y):lt(0.85 - smoothstep(0.1, 0.4, clearing))
    p:set(tree, select(point.isHere & isLand & grows, kindOfTree(p, point), -1))
    p:set(treeBase, int(ground) + 1)
    local small = p:scatter("undergrowth", 11, 4)
    local kind = p:random2D("kind of undergrowth", small.at.x, small.at.y)
    local shape = multiSelect({
        {kind:lt(0.5), shapeOf(trees.bush, small.hash)},
        {kind:lt(0.65), shapeOf(trees.fallenLog, small.hash)},
        {kind:lt(0.8), shapeOf(trees.boulder, small.hash)},
    }, -1)
    p:set(low, select(small.isHere & isLand, shape, -1))
    p:set(lowBase, int(ground) + 1)
end)

-- The color of grass follows a wide noise, from dark and cool to light and warm.
g:pass2D("colors", function(p)
    local warm = smoothstep(-0.5, 0.6, p:perlin2D("warmth", 256, {1}))
    p:set(grassColor, packColor(lerp(0.30, 0.46, warm), lerp(0.46, 0.55, warm), lerp(0.24, 0.2, warm)))
end)
g:tint(grassColor)

g:pass3D("ground", function(p)
    local ground = p:read(height)
    local depth = ground - float(p.z)
    local isShore = ground:lt(seaLevel + 1.5)
    local floorNoise = p:perlin2D("forest floor", 12, {0.6, 0.6})
    local top = multiSelect({{isShore, "sand"}, {floorNoise:gt(0.45), "moss"}}, "grass")
    local soil = select(isShore, "sand", "dirt")
    local plants = p:stamp(tree, treeBase)
    plants = select(plants:eq("air"), p:stamp(low, lowBase), plants)
    local open = select(p.z:le(seaLevel), "water", plants)
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}, {depth:lt(4), soil}}, "stone"))
end)

if g.step <= 2 then
    g:pass3D("ferns", function(p)
        local below = p:blockInColumn(p.z - 1)
        p:if_(p:blockHere():eq("air") & p.z:gt(2), function()
            local chance, patch = p:random2D("fern"), p:perlin2D("ferns", 16, {1})
            p:setBlock(multiSelect({
                {below:eq("moss") & chance:lt(0.35), "fern"},
                {below:eq("grass") & patch:gt(0.2) & chance:lt(0.3), "fern"},
                {below:eq("grass") & chance:lt(0.1), "grass_tuft"},
                {below:eq("grass") & chance:gt(0.995), "red_mushroom"},
            }, "air"))
        end)
    end)
end
