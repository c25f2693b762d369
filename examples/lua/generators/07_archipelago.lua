-- 7. Archipelago: islands with lagoons, beaches, reefs and palms.

local seaLevel <const> = 80
local height = g:field("height", "float")
local palm, palmBase = g:field("palm", "int"), g:field("palm base", "int")
local trees = g:trees()

g:pass2D("land", function(p)
    -- An island of random size around each point of a Voronoi diagram.
    local cells = p:voronoi2D("islands", 220, 1)
    local center = p.x + cells.offset.x
    local size = p:random2D("size", center, p.y + cells.offset.y) * 0.6 + 0.3
    local shape = p:perlin2D("coasts", 16, {0.03, 0.05, 0.1, 0.16})
    -- The ratio is 1 where two islands are equally far: there is always water.
    local channel = (1 - cells.ratio) * 1.6 - 0.25
    local inland = min(size - cells.distance * (1 / 150), channel) + shape
    local beach = 66 + smoothstep(-0.35, 0.12, inland) * 15.5
    local hills = smoothstep(0.12, 0.6, inland) * (34 + p:perlin2D("hills", 24, {3, 8, 9}))
    p:set(height, beach + hills)
end)

g:pass2D("palms", function(p)
    local point = p:scatter("palms", 6, 3)
    local ground = p:read(height)
    local where = ground:gt(seaLevel + 1.2) & ground:lt(seaLevel + 24)
    local density = 0.25 + p:perlin2D("groves", 40, {0.5})
    local grows = point.isHere & where & p:random2D("palm grows", point.at.x, point.at.y):lt(density)
    local high = ground:gt(seaLevel + 7)
    local shape = select(high, shapeOf(trees.bush, point.hash), shapeOf(trees.palm, point.hash))
    p:set(palm, select(grows, shape, -1))
    p:set(palmBase, int(ground) + 1)
end)

g:pass3D("ground", function(p)
    local ground, z = p:read(height), float(p.z)
    local depth = ground - z
    local steepness = length(p:slope(height))
    local top = multiSelect({
        {ground:lt(seaLevel + 2.5 + p:perlin2D("beaches", 16, {1})), "sand"},
        {steepness:gt(1.5), "basalt"},
    }, "grass")
    local soil = select(ground:lt(seaLevel + 3), "sand", "dirt")
    local open = select(p.z:le(seaLevel), "water", p:stamp(palm, palmBase))
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}, {depth:lt(4), soil}}, "basalt"))
end)

-- Corals and seagrass where the water is shallow.
if g.step <= 2 then
    g:pass3D("reef", function(p)
        local below = p:blockInColumn(p.z - 1)
        local isSea = p:blockHere():eq("water") & below:eq("sand") & p.z:gt(seaLevel - 9) & p.z:lt(seaLevel)
        p:if_(isSea, function()
            local reef, chance = p:perlin2D("reefs", 20, {1}), p:random2D("coral")
            p:setBlock(multiSelect({
                {reef:gt(0.25) & chance:lt(0.2), "coral_red"},
                {reef:gt(0.25) & chance:lt(0.35), "coral_yellow"},
                {reef:lt(-0.2) & chance:lt(0.3), "seagrass"},
            }, "water"))
        end)
    end)
end
