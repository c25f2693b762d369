local s = g:shape {name = "aside", blocks = {{name = "stone"}}, voxels = {{5, 5, 0, 1}}}
