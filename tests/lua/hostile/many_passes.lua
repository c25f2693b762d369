for i = 1, 1e9 do g:pass3D("pass " .. i, function(p) end) end
