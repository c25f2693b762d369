-- Tall land: mountains of 1,500, cliffs, islands in the sky, and caves down to -800.
g:heights(-1024, 1792)

local height = g:field("height", "float")
local cover = g:field("cover", "block")

g:pass2D("land", function(p)
    local land = p:perlin2D("land", 512, {8, 24, 60})
    local where = smoothstep(-0.1, 0.6, p:perlin2D("ranges", 2048, {0.6, 1}))
    -- Noise near 0 is a ridge: |noise| is a valley there, and 1 - |noise| a crest.
    local crest = 1.0 - abs(p:perlin2D("crests", 256, {0.2, 0.4, 1})) * 1.4
    local rocks = p:perlin2D("rocks", 16, {2, 5, 12, 24})
    local tops = where * (max(crest, 0.0) * 1900.0 + rocks * 1.5)
    -- A step up of some hundred blocks: the edge of a plateau.
    local plateau = smoothstep(0.28, 0.3, p:perlin2D("plateaus", 1024, {0.3, 1})) * 340.0
    p:set(height, floor(min(90.0 + land + tops + plateau, 1700.0)))
end)

g:pass2D("cover", function(p)
    local here = p:read(height)
    local slope = p:slope(height)
    p:set(cover, multiSelect({
        {here:le(81.0), "sand"},
        {(abs(slope.x) + abs(slope.y)):gt(2.5), "stone"},
        {here:gt(640.0), "snow"},
    }, "grass"))
end)

g:pass3D("ground", function(p)
    local top = int(p:read(height))
    local depth = top - p.z
    local block = p:var(select(p.z:le(80), "water", "air"))
    p:if_(depth:ge(0), function() block.value = "stone" end)
    p:if_(depth:ge(0) & depth:lt(3), function() block.value = p:read(cover) end)
    -- Caves: halls in the deep, passages near the ground, none near the sea and below -800.
    p:if_(depth:gt(2) & top:gt(90) & p.z:gt(-800), function()
        local hall = p:perlin3D("halls", 24, {0.2, 0.4, 1})
        block.value = select(hall:gt(0.40), "air", block.value)
    end)
    -- Islands in the sky: a lens of rock around 900.
    p:if_(p.z:gt(840) & p.z:lt(960) & depth:lt(-60), function()
        local island = p:perlin2D("islands", 256, {0.3, 1}) - float(abs(p.z - 900)) * 0.01
        local rough = p:perlin3D("roughness", 8, {0.02, 0.04})
        block.value = select((island + rough):gt(0.45), select(p.z:gt(906), "grass", "stone"), block.value)
    end)
    p:setBlock(block.value)
end)
