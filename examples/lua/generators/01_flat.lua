-- 1. Flat: the smallest generator that is a place to build in. A 3D pass gives each voxel its block.

g:pass3D("ground", function(p)
    local z = p.z
    p:setBlock(multiSelect({
        {z:gt(81), "air"},
        -- Flowers in patches: noise says where, a random number which columns.
        {z:eq(81), select(p:perlin2D("meadows", 24, {1}):gt(0.2) & p:randomBool2D("flower", 0.15), "poppy", "air")},
        {z:eq(80), "grass"},
        {z:gt(76), "dirt"},
    }, "stone"))
end)
