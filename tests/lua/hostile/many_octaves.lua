g:pass2D("noise", function(p)
    local weights = {}
    for i = 1, 64 do weights[i] = 1 end
    p:perlin2DWithGrain("n", 65536, weights)
end)
