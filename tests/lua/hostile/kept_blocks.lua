-- Each chunk would keep the blocks of 31 passes for its neighbors: 4 MiB.
for i = 1, 31 do
    g:pass3D("pass " .. i, function(p) p:setBlock(select(p.z:lt(i), "stone", "air")) end)
end
g:pass3D("last", function(p) p:setBlock(p:blockAt(1, 0, p.z)) end)
