_G.x.y = 1
