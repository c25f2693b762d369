local s = ("%99d"):rep(200)
while true do string.format(s, 1) end
