g:pass3D("slow", function(p)
    local v = p:var(p.z)
    p:while_(function() return v.value:gt(0) end, function()
        for i = 1, 200 do v.value = v.value * 3 + i end
    end)
    p:setBlock(select(v.value:gt(0), "stone", "air"))
end)
