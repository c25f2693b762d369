local t = {}
for i = 1, 1e9 do t[i * ((1 << 24) - 1) * (1 << 20)] = true end
