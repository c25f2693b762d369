// Shadow maps of figures have depth only.
void main() {}
