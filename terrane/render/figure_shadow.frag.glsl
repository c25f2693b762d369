// Depth is all that is kept of figures in a shadow map.
void main() {}
