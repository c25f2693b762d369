local s = (""):rep(1 << 30)
while true do s = (""):rep(2147483647) end
