("a"):match("a")
