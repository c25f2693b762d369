g:pass2D("names", function(p)
    for i = 1, 1e9 do p:random2D("name " .. i) end
end)
