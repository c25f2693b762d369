"""The pages whose steps need no window."""
import re


def library(page):
    with page.step(1):
        page.run("./run build")
        page.run("cmake --install build --prefix ~/.local")
    with page.step(2):
        page.run("mkdir -p ~/first && cd ~/first")
        page.write("CMakeLists.txt", page.code("cmake"))
    with page.step(3):
        page.write("first.cpp", page.code("cpp"))
    with page.step(4):
        page.run('cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$HOME/.local"')
        page.run("cmake --build build")
        page.run("./build/first")
        page.prints("ground at 8,8: z = 86", "above the lamp: red 13, daylight 15", "22 quads, 176 bytes")


def promised_output(page):
    """The lines of the indented blocks between steps 2 and 6 that are not commands."""
    steps = page.text[page.text.index("## 2."):page.text.index("## 7.")]
    return [line.strip() for line in re.findall(r"^    (\S.*)$", re.sub(r"```.*?```", "", steps, flags=re.DOTALL), re.MULTILINE)]


def python(page):
    with page.step(1):
        page.run('export PYTHONPATH="$PWD/build/python"')
        page.run('/usr/bin/python3 -c "import terrane; print(terrane.__version__, terrane.generators())"')
        page.prints("['overworld', 'continents', 'wilderness', 'flat', 'hills3d', 'voronoi']")
    with page.step(2, 6):
        page.do("mkdir -p ~/python && cd ~/python")
        count = page.text.count("```python")
        page.write("steps.py", "\n".join(page.code("python", k) for k in range(count)))
        page.do("/usr/bin/python3 steps.py")
        page.prints(*promised_output(page))
        page.do("test -s heights.pgm -a -s view.ppm -a -s python.sqlite")
