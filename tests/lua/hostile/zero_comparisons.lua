local zeros = ("\0"):rep(60000)
local a, b = zeros .. "a", zeros .. "b"
while true do local less = a < b end
