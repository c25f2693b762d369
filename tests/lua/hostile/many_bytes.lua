local s = ("x"):rep(60000)
while true do local a = s:byte(1, -1) end
