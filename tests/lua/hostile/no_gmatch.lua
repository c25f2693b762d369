("a"):gmatch("a")
