local map = g:drainage("rivers", {}, function(p)
    local v = p:var(0)
    p:while_(function() return v.value:lt(p.x) end, function()
        for k = 1, 20 do v.value = v.value * 3 + k end
    end)
    return float(v.value)
end)
g:pass3D("ground", function(p) p:setBlock("stone") end)
