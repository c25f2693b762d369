g:pass2D("outer", function() g:pass2D("inner", function() end) end)
