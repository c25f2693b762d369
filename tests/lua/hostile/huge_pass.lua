g:pass3D("huge", function(p)
    local x = p.x
    for i = 1, 1e9 do x = x * 3 + i end
    p:setBlock(select(x:eq(0), "stone", "air"))
end)
