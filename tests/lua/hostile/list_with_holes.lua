g:pass2D("noise", function(p) p:perlin2D("n", 8, {1, nil, 1, nil, nil, 1, [9] = 1}) end)
