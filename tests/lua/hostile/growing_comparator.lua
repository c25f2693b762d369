local t = {3, 1, 2}
table.sort(t, function(a, b) for i = 1, 1e5 do t[#t + 1] = i end return a < b end)
table.sort(t, function() error("stop") end)
