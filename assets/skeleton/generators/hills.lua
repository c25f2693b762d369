-- Hills with veins of glow rock. The script runs once and records what is to be computed for each column (pass2D) and each
-- voxel (pass3D); nothing of Lua runs while the land is made. docs/lua.md of Terrane has all functions.

local height = g:field("height", "int")

g:pass2D("land", function(p)
    -- Noise over lattices of 32, 64 and 128 blocks, with the weight of each.
    p:set(height, int(84 + p:perlin2D("hills", 32, {2, 5, 14})))
end)

g:pass3D("ground", function(p)
    local depth = p:read(height) - p.z
    local block = p:var(select(p.z:le(80), "water", "air"))
    -- Only below the ground: noise in space is the costly thing.
    p:if_(depth:ge(0), function()
        local vein = abs(p:perlin3D("veins", 12, {1}))
        block.value = multiSelect({
            {vein:lt(0.05) & depth:gt(2), "glow_rock"},
            {depth:lt(1) & p.z:ge(80), "grass"},
            {depth:lt(4), "dirt"},
        }, "stone")
    end)
    p:setBlock(block.value)
end)

-- Crystals stand on the grass, here and there.
g:pass3D("crystals", function(p)
    local isOpen = p:blockHere():eq("air") & p:blockInColumn(p.z - 1):eq("grass")
    p:if_(isOpen & p:randomBool3D("crystal", 0.004), function()
        p:setBlock("crystal")
    end)
end)
