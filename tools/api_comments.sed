#!/bin/sed -Ef
# Turns the comments of a header into those that Doxygen reads: in front of a declaration, or behind it on its line.
s|^( *)// ?|\1/// |
s|^([^/]*[;,{}]) +// |\1 ///< |
# The head of a file is about the file.
1s|^/// |/// @file\n/// |
# What stands for something else in Doxygen.
/\/\/\//s/([<>#@\\])/\\\1/g
s|/\\|/|g
