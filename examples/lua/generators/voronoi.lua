-- Mountains made only of Voronoi diagrams: bowls with a lake around every point, sharp ridges between
-- them, and boxy caves of a diagram in space. The same blocks, to the bit, as terrane/gen/generators/small_generators.cpp.

local seaLevel <const> = 80
local spacing <const> = 96  -- blocks between the points of two bowls, about
local height = g:field("height", "int")

-- Walls rise with the square of the distance, so that they are steepest at the ridge.
g:pass2D("bowls", function(p)
    local far = p:voronoi2D("bowls", spacing, 1).distance * (1 / spacing)
    local fold = p:voronoi2D("folds", 24, 1).distance * (1 / 24)
    p:set(height, int(74 + far * far * 110 + fold * far * 14))
end)

-- Cells of cubes: the metric's exponent is 8.
local function carveChambers(p, block)
    local cells = p:voronoi3D("chambers", 28, 1, 8)
    local isChamber = cells.distance:lt(9) & p:perlin3D("where", 64, {1}):gt(0.1)
    local isFloor = cells.offset.z:eq(8)
    local inside = select(isFloor & cells.ratio:lt(0.3), "glowing_ore", "air")
    p:if_(isChamber, function() block.value = inside end)
end

g:pass3D("ground", function(p)
    local z, top = p.z, p:read(height)
    local depth = top - z
    local snowLine = 140 + int(p:random2D("snow line") * 6)
    local cover = multiSelect({{top:le(seaLevel + 1), "sand"}, {top:gt(snowLine), "snow"}}, "grass")
    local block = p:var(select(z:le(seaLevel), "water", "air"))
    p:if_(depth:ge(0), function() block.value = "stone" end)
    p:if_(depth:ge(0) & depth:lt(3), function() block.value = cover end)
    -- Caves are not visible from afar, and cost most.
    if p.step == 1 then
        p:if_(depth:gt(6) & z:gt(3), function() carveChambers(p, block) end)
    end
    p:setBlock(block.value)
end)
