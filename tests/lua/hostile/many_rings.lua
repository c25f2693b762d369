local last = g:field("field 0", "int")
g:pass2D("first", function(p) p:set(last, p.x) end)
for i = 1, 20 do
    local before, here = last, g:field("field " .. i, "int")
    g:pass2D("pass " .. i, function(p) p:set(here, p:readAt(before, 16, 16)) end)
    last = here
end
g:pass3D("ground", function(p) p:setBlock(select(p:read(last):gt(0), "stone", "air")) end)
