local voxels = {}
for z = 0, 40 do for y = -16, 16 do for x = -16, 16 do voxels[#voxels + 1] = {x, y, z, 1} end end end
for i = 1, 1e9 do g:shape {name = "box " .. i, blocks = {{name = "stone"}}, voxels = voxels} end
