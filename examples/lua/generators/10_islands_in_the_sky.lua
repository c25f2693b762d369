-- 10. Islands in the sky: flat above, ragged below, with trees, with nothing below.

local lowest <const> = 100
local top = g:field("top", "float")        -- of the island of a column
local bottom = g:field("bottom", "float")  -- above the top where there is no island
local tree, treeBase = g:field("tree", "int"), g:field("tree base", "int")
local trees = g:trees()

g:pass2D("islands", function(p)
    local cells = p:voronoi2D("islands", 140, 1)
    local cx, cy = p.x + cells.offset.x, p.y + cells.offset.y
    -- Height and size of each island are random.
    local level = lowest + p:random2D("level", cx, cy) * 80
    local size = 0.28 + p:random2D("size", cx, cy) * 0.3
    local coast = p:perlin2D("coasts", 12, {0.03, 0.06, 0.1})
    local gap = (1 - cells.ratio) * 1.5 - 0.2  -- below 0 where the next island begins
    local inside = min(size - cells.distance * (1 / 140), gap) + coast  -- above 0 on the island
    local hills = smoothstep(0, 0.3, inside) * (6 + p:perlin2D("hills", 16, {1, 3, 5}))
    -- The rock beneath hangs in points, longest in the middle.
    local points = p:voronoi2D("points", 18, 1).distance * (1 / 18)
    local hanging = sqrt(max(inside, 0)) * (48 - points * 34)
    p:set(top, level + hills)
    p:set(bottom, select(inside:gt(0), level - hanging, 1000))
end)

g:pass2D("trees", function(p)
    local point = p:scatter("trees", 8, 5)
    local thick = p:read(top) - p:read(bottom)
    local grows = p:random2D("tree grows", point.at.x, point.at.y):lt(0.55)
    local isGrove = p:perlin2D("kinds", 64, {1}):gt(0.1)
    local shape = select(isGrove, shapeOf(trees.birch, point.hash), shapeOf(trees.willow, point.hash))
    p:set(tree, select(point.isHere & thick:gt(14) & grows, shape, -1))
    p:set(treeBase, int(p:read(top)) + 1)
end)

g:pass3D("ground", function(p)
    local z = float(p.z)
    local depth = p:read(top) - z
    local isRock = depth:ge(0) & z:ge(p:read(bottom))
    local rock = select(p:perlin2D("rock", 24, {1}):gt(0.1), "limestone", "stone")
    local island = multiSelect({
        {depth:lt(1), "grass"},
        {depth:lt(4), "dirt"},
        -- Crystals shine at the tips.
        {z:lt(p:read(bottom) + 2) & p:randomBool3D("crystal", 0.06), "crystal"},
    }, rock)
    p:setBlock(select(isRock, island, p:stamp(tree, treeBase)))
end)

if g.step <= 2 then
    g:pass3D("plants", function(p)
        p:if_(p:blockHere():eq("air") & p.z:gt(2) & p:blockInColumn(p.z - 1):eq("grass"), function()
            local chance, meadow = p:random2D("plant"), p:perlin2D("meadow", 20, {1})
            p:setBlock(multiSelect({
                {chance:lt(0.15), "tall_grass"},
                {meadow:gt(0.15) & chance:lt(0.3), "blue_orchid"},
                {meadow:lt(-0.15) & chance:lt(0.3), "heather"},
            }, "air"))
        end)
    end)
end
