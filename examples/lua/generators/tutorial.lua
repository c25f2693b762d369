-- Step 4 of the tutorial in docs/lua.md: mountains, caves, mushrooms in them. The same blocks, to the bit, as writeStep4
-- in examples/tutorial_generators.cpp.

local height = g:field("height", "int")
local cover = g:field("cover", "block")

g:pass2D("land", function(p)
    local hills = p:perlin2D("hills", 32, {2, 5, 12})
    local where = smoothstep(0, 0.5, p:perlin2D("mountains", 256, {1}))
    local ridge = p:voronoi2D("ridges", 160, 1).distance * (1 / 160)
    p:set(height, int(82 + hills + where * ridge * 120))
end)

-- Rock on steep ground, from the heights around, and snow on high ground.
g:pass2D("cover", function(p)
    local here = p:read(height)
    local dx = p:readAt(height, 1, 0) - p:readAt(height, -1, 0)
    local dy = p:readAt(height, 0, 1) - p:readAt(height, 0, -1)
    p:set(cover, multiSelect({
        {here:le(81), "sand"},
        {(abs(dx) + abs(dy)):gt(4), "stone"},
        {here:gt(128), "snow"},
    }, "grass"))
end)

-- 3D noise is expensive: it is inside an if_, so that layers of air and water skip it.
g:pass3D("ground", function(p)
    local depth = p:read(height) - p.z
    local block = p:var(select(p.z:le(80), "water", "air"))
    p:if_(depth:ge(0), function() block.value = "stone" end)
    p:if_(depth:ge(0) & depth:lt(3), function() block.value = p:read(cover) end)
    p:if_(p.z:le(p:read(height)) & p:read(height):gt(84) & p.z:gt(2), function()
        local rock = p:perlin3D("caves", 12, {0.4, 0.7, 1})
        block.value = select(rock:gt(0.42), "air", block.value)
    end)
    p:setBlock(block.value)
end)

-- A last pass reads the blocks left by the caves: mushrooms on their floors, tufts on the grass.
g:pass3D("plants", function(p)
    local below = p:blockInColumn(p.z - 1)
    p:if_(p:blockHere():eq("air") & p:randomBool3D("grows", 0.1), function()
        local isDeep = p.z:lt(p:read(height) - 4)
        p:setBlock(multiSelect({
            {below:eq("grass"), "grass_tuft"},
            {isDeep & below:eq("stone"), "glowing_mushroom"},
        }, "air"))
    end)
end)
