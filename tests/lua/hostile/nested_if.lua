g:pass2D("nested", function(p)
    local function deeper() p:if_(p.x:gt(0), deeper) end
    deeper()
end)
