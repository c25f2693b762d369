g:drainage("d", {}, function(p)
    local fields = {}
    for i = 1, 100 do fields[i] = g:field("f" .. i, "float") end
    p:set(fields[100], 1.0)
    return p:read(fields[100])
end)
