g:pass3D("nested", function(p)
    local v = p:var(p.x)
    local function always() return v.value:gt(0) end
    local function step() v.value = v.value + 1 end
    p:while_(always, function()
        p:while_(always, function() p:while_(always, step) end)
    end)
    p:setBlock(select(v.value:gt(0), "stone", "air"))
end)
