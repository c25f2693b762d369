local map = g:drainage("d", {}, function(p) return 1 end)
local x = -map
