for i = 1, 1e9 do g:field("field " .. i, "int") end
