-- 4. Caves: tunnels where two noises are both near 0, halls where a third is large, and plants and crystals in them.

local seaLevel <const> = 80
local height = g:field("height", "float")

g:pass2D("land", function(p)
    p:set(height, 104 + p:perlin2D("hills", 32, {2, 5, 9, 12}))
end)

local function isTunnel(p)
    -- Each noise is near 0 on a winding surface; two surfaces meet in a winding line.
    local a = p:perlin3D("tunnels a", 32, {0.4, 1})
    local b = p:perlin3D("tunnels b", 32, {0.4, 1})
    return (a * a + b * b):lt(0.014)
end

local function isHall(p)
    local low = 1 - smoothstep(20, 70, float(p.z))  -- halls lie deep
    return (p:perlin3D("halls", 24, {0.3, 1}) + low * 0.35):gt(0.72)
end

g:pass3D("ground", function(p)
    local depth = p:read(height) - float(p.z)
    local block = p:var(select(p.z:le(seaLevel), "water", "air"))
    p:if_(depth:ge(0), function()
        block.value = multiSelect({
            {depth:lt(1), select(p:read(height):lt(seaLevel + 1.5), "sand", "grass")},
            {depth:lt(4), "dirt"},
            {p:perlin3D("limestone", 48, {1}):gt(0.25), "limestone"},
        }, "stone")
    end)
    -- 3D noise costs most: it is computed only where a cave may be, away from the water and the bottom. Caves are not
    -- visible from afar.
    if p.step <= 2 then
        p:if_(depth:ge(0) & p.z:gt(4) & p:read(height):gt(seaLevel + 4), function()
            block.value = select(isTunnel(p) | isHall(p), "air", block.value)
        end)
    end
    p:setBlock(block.value)
end)

-- Crystals hang from the roofs of deep halls, mushrooms stand on their floors.
if g.step == 1 then
    g:pass3D("growth", function(p)
        local isCave = p:blockHere():eq("air") & float(p.z):lt(p:read(height) - 8) & p.z:gt(2)
        p:if_(isCave, function()
            local below, above = p:blockInColumn(p.z - 1), p:blockInColumn(p.z + 1)
            local isFloor = below:eq("stone") | below:eq("limestone")
            local isRoof = above:eq("stone") | above:eq("limestone")
            local chance = p:random3D("growth")
            p:setBlock(multiSelect({
                {isFloor & chance:lt(0.05), "glowing_mushroom"},
                {isFloor & chance:lt(0.08), "brown_mushroom"},
                {isRoof & chance:gt(0.985) & p.z:lt(60), "glowing_ore"},
            }, "air"))
        end)
    end)
end
