("a"):gsub("a", "b")
