g:pass2D("variables", function(p)
    for i = 1, 1e9 do p:var(i) end
end)
