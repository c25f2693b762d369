local f = g:field("f", "int")
g:pass2D("a", function(p)
    local v, c = p:var(0), p.x:gt(0)
    for k = 1, 9000 do
        p:if_(c, function() v.value = v.value + 1 end, function() v.value = 0 end)
    end
    p:set(f, v.value)
end)
g:pass3D("ground", function(p) p:setBlock(select(p:read(f):gt(3), "stone", "air")) end)
