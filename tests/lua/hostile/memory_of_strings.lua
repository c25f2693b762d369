local all = {}
for i = 1, 1e9 do all[#all + 1] = ("x"):rep(60000) .. i end
