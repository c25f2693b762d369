local s, kept = ("x"):rep(32000), {}
for k = 1, 2000 do kept[k] = s .. k end
while true do local text = s .. "y" end
