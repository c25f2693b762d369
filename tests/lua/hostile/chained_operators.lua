g:pass3D("chain", function(p)
    local x = p:simplex3D("rock", 8, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1})
    while true do x = x * x + p:simplex3D("rock", 8, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}) end
end)
