local s, x = ("a"):rep(60000), ("a"):rep(1000) .. "b"
while true do s:find(x) end
