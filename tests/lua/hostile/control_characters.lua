error("\27[31mred\n\nlines\0end")
