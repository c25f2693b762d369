local all = {}
for i = 1, 1e9 do all = {all, i} end
