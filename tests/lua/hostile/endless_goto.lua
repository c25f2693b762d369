::again::
local t = {}
t.x = 1
goto again
