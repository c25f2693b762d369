-- Land from 3D noise: hills with overhangs, arches and floating rocks, grass wherever the sky is near.
-- The same blocks, to the bit, as terrane/gen/generators/small_generators.cpp.

local seaLevel <const> = 80
local middle = g:field("middle", "float")

-- Solid where the noise exceeds the threshold, which grows with the height above the middle of the land.
local function isSolid(p)
    local above = float(p.z) - p:read(middle)
    local solid = p:var(above:lt(0))
    p:if_(abs(above):lt(48), function()
        local density = p:simplex3D("rock", 24, {0.25, 1}) + p:perlin3D("bulk", 64, {0.7})
        solid.value = density:gt(above * (1 / 34))
    end)
    return solid.value | p.z:eq(0)
end

g:pass2D("land", function(p)
    p:set(middle, 90 + p:simplex2D("land", 256, {7, 20}))
end)

g:pass3D("ground", function(p)
    local open = select(p.z:le(seaLevel), "water", "air")
    p:setBlock(select(isSolid(p), "stone", open))
end)

-- Grass lies under the open, soil under grass; sand where water is near.
g:pass3D("soil", function(p)
    local z = p.z
    local function isStone(at) return p:blockInColumn(at):eq("stone") end
    p:if_(p:blockHere():eq("stone") & z:gt(1) & z:lt(255), function()
        local isShore = z:le(seaLevel + 1)
        local top = select(isShore, "sand", "grass")
        local soil = select(isShore, "sand", "dirt")
        p:setBlock(multiSelect({{~isStone(z + 1), top}, {~isStone(z + 3), soil}}, "stone"))
    end)
end)

-- A flower as wide as a column of 4 blocks would be a tree.
if g.step <= 2 then
    g:pass3D("plants", function(p)
        local z = p.z
        p:if_(p:blockHere():eq("air") & z:gt(0) & p:blockInColumn(z - 1):eq("grass"), function()
            local kind = p:random2D("kind")
            local flower = multiSelect({{kind:lt(0.15), "poppy"}, {kind:lt(0.3), "oxeye_daisy"}}, "grass_tuft")
            p:setBlock(select(p:randomBool3D("grows", 0.12), flower, "air"))
        end)
    end)
end
