"""Chooses places with equally open views by the heights of the ground only, with one rule for all programs."""
import array
import ast
import math

CELL = 8               # blocks; a cell has the minimum of its heights
EYE = 40               # blocks from the ground or the water to the camera
FAR = 256              # blocks
DIRECTIONS = 32
LAND = 0.5             # least share of land within FAR
STEP = 4               # cells between candidates
APART = 200            # least distance of two places, blocks
TARGETS = (0.6, 0.5, 0.7, 0.55, 0.65)  # openness of the first, the second, … place


class Heights:
    """Heights by cell."""

    def __init__(self, heights, water):
        self.heights, self.water = heights, water

    def surface(self, x, y):
        return max(self.heights[x, y], self.water)

    def _rays(self, x, y):
        for direction in range(DIRECTIONS):
            angle = 2 * math.pi * direction / DIRECTIONS
            yield [(x + round(distance * math.cos(angle) / CELL), y + round(distance * math.sin(angle) / CELL), distance)
                   for distance in range(2 * CELL, FAR + 1, CELL)]

    def openness(self, x, y):
        """Share of the cells within FAR that a camera EYE above this cell sees; None if heights are missing."""
        eye, seen, count = self.surface(x, y) + EYE, 0, 0
        for ray in self._rays(x, y):
            highest = -math.inf
            for cell_x, cell_y, distance in ray:
                if (cell_x, cell_y) not in self.heights:
                    return None
                slope = (self.surface(cell_x, cell_y) - eye) / distance
                count += 1
                if slope >= highest:
                    seen, highest = seen + 1, slope
        return seen / count

    def land(self, x, y):
        cells = [(cell_x, cell_y) for ray in self._rays(x, y) for cell_x, cell_y, _ in ray]
        return sum(self.heights[cell] > self.water for cell in cells) / len(cells)

    def places(self, count):
        """(x, y, height of the camera, openness), positions in blocks, in the order of TARGETS."""
        candidates = []
        for x, y in sorted(self.heights):
            if x % STEP or y % STEP or (openness := self.openness(x, y)) is None:
                continue
            if self.land(x, y) >= LAND:
                candidates.append((x, y, openness))
        chosen = []
        for number in range(count):
            target = TARGETS[number % len(TARGETS)]
            free = [c for c in candidates if all(math.dist(c[:2], other[:2]) * CELL >= APART for other in chosen)]
            if not free:
                break
            chosen.append(min(free, key=lambda c: abs(c[2] - target)))
        middle = CELL // 2
        return [(x * CELL + middle, y * CELL + middle, self.surface(x, y) + EYE, round(openness, 3))
                for x, y, openness in chosen]


def read_lines(path, water):
    """Reads lines "x z height" of the Lua mod. Layers overlap: the highest value counts; a layer without ground has the least."""
    heights = {}
    for line in path.read_text(encoding="ascii").splitlines():
        x, y, height = (int(float(word)) for word in line.split())
        cell = x // CELL, y // CELL
        heights[cell] = max(height, heights.get(cell, height))
    return Heights(heights, water)


def read_npy(path, begin, water):
    """Reads uint16 [y, x] of `terrane export npy-heights`; `begin`: the first column, in blocks."""
    data = path.read_bytes()
    length = int.from_bytes(data[8:10], "little")
    rows, columns = ast.literal_eval(data[10:10 + length].decode("ascii"))["shape"]
    values = array.array("H", data[10 + length:])
    heights = {}
    for y in range(0, rows - CELL + 1, CELL):
        lines = [values[(y + n) * columns:(y + n + 1) * columns] for n in range(CELL)]
        least = list(map(min, *lines))
        for x in range(0, columns - CELL + 1, CELL):
            heights[(x + begin) // CELL, (y + begin) // CELL] = min(least[x:x + CELL])
    return Heights(heights, water)
