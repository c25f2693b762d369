local f = pairs({1})
f(0x41414141) f(print) f(g) f(nil) f()
f("text", 1, {})
error("survived")
