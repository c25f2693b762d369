-- 2. Hills and lakes. A 2D pass computes the height once per column and passes it on in a field.

local seaLevel <const> = 80
local height = g:field("height", "float")

g:pass2D("land", function(p)
    -- Weights of lattices of 32, 64, 128 and 256 blocks: wide hills are high, small ones low.
    local hills = p:perlin2D("hills", 32, {1.5, 4, 9, 16})
    -- The land rises slowly from the water and faster above it, so that shores are wide.
    p:set(height, seaLevel + 6 + hills * (0.75 + smoothstep(0, 14, hills) * 0.6))
end)

g:pass3D("ground", function(p)
    local ground = p:read(height)
    local depth = ground - float(p.z)  -- blocks below the surface
    local isShore = ground:lt(seaLevel + 1.5)
    local soil = select(isShore, "sand", "dirt")
    local top = select(isShore, "sand", "grass")
    local open = select(p.z:le(seaLevel), "water", "air")
    p:setBlock(multiSelect({{depth:lt(0), open}, {depth:lt(1), top}, {depth:lt(4), soil}}, "stone"))
end)

-- Plants stand on blocks of the pass before. Columns wider than 2 blocks have none.
if g.step <= 2 then
    g:pass3D("plants", function(p)
        local isFree = p:blockHere():eq("air") & p.z:gt(1)
        p:if_(isFree & p:blockInColumn(p.z - 1):eq("grass"), function()
            local meadow = p:perlin2D("meadow", 40, {1, 1})
            local flower = select(meadow:gt(0.3), "oxeye_daisy", "bluebell")
            local kind = p:random2D("kind of plant")
            local grows = p:random2D("plant"):lt(0.12 + meadow * 0.15)
            p:setBlock(multiSelect({{~grows, "air"}, {kind:lt(0.75), "grass_tuft"}, {kind:lt(0.85), "tall_grass"}}, flower))
        end)
    end)
end
