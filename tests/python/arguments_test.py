"""Arguments of all functions: one rule for wrong values, one for calls that do not fit (docs/python.md)."""
import ast
import decimal
import fractions
import inspect
import pathlib
import types

import numpy as np
import pytest
import terrane

from conftest import fails

NAN, INFINITY = float("nan"), float("inf")


class Index:
    """An integer of another type."""

    def __index__(self):
        return 1


class Nameless:
    """A value whose text has two lines."""

    def __repr__(self):
        return "two\nlines"


class Endless:
    """A sequence that says it is long, and always has one more element."""

    def __len__(self):
        return 2**62

    def __getitem__(self, k):
        return "isles"


class Broken:
    """A value that cannot be shown."""

    def __repr__(self):
        raise RuntimeError("no text")


NO_INTEGERS = [0.7, 3.0, NAN, INFINITY, -INFINITY, np.float32(3), np.float64(0.5), np.float16(1), True, False, np.bool_(True),
               "3", "", b"3", 1 + 0j, decimal.Decimal(1), fractions.Fraction(1, 2), [1], (1,), {}, {1}, np.array([1]),
               np.array([[1]]), np.array(1.5), np.array(True), np.array("1"), object(), Nameless(), Broken(), int, len,
               "\ud800", np.datetime64("2026-01-01"), range(3), iter(())]
HUGE = [2**63, -2**63 - 1, 2**64, 2**70, -2**70, 10**5000]
INTEGERS = [1, np.int8(1), np.int16(1), np.int32(1), np.int64(1), np.uint8(1), np.uint16(1), np.uint32(1), np.uint64(1),
            np.array(1), np.array(1, np.uint16), Index()]
NO_NUMBERS = [NAN, INFINITY, -INFINITY, np.float32(NAN), np.float64(INFINITY), True, np.bool_(False), None, "0.5", b"0.5", 1j,
              decimal.Decimal(1), [0.5], (1.0,), np.array([0.5]), np.array([[1.0]]), np.array("1"), object(), Broken(), 10**400]
NO_BOOLS = [None, 0, 1, 2, 0.0, 1.0, NAN, "", "True", b"", [], [1], (), {}, np.int64(1), np.float32(1), np.array([True, False]),
            np.array([]), object(), Nameless(), Broken()]
NO_TEXTS = [0, 1.5, NAN, True, b"flat", bytearray(b"flat"), [], ["flat"], ("flat",), {}, np.array(["flat"]), np.int64(1),
            pathlib.Path("flat"), object(), Nameless(), Broken(), "\ud800", "a\0b"]
NO_LISTS_OF_TEXTS = [None, 1, 1.5, NAN, True, "isles", b"isles", object(), {}, {"isles"}, [1], [None], [b"isles"], ["isles", 1.5],
                     [["isles"]], [pathlib.Path("isles")], np.array([1]), ("a\0b",), ["\ud800"], iter(["isles"]), Endless()]


def no_sequences(*good):
    """Wrong values for a sequence of integers, one of which is `good`."""
    elements = [value for value in NO_INTEGERS + HUGE + [None] if not isinstance(value, range)]
    wrong = [(*good[:-1], element) for element in elements] + [(element, *good[1:]) for element in elements]
    floats = [np.array(good, kind) for kind in (np.float32, np.float64, complex)]
    return wrong + floats + [None, 1, 1.5, NAN, True, "", "abcd", b"abcd", (), good[:-1], (*good, 1), [list(good)], {}, set(good),
                             object(), np.array([good, good]), np.array(good, bool), np.array(good).reshape(-1, 1),
                             np.array(3), np.array([str(value) for value in good]), iter(good), Nameless(), Broken()]


NO_POSITIONS = [None, 1, 1.5, True, "", "ab", b"ab", (), [], [1, 2], [(0.7, 5.9)], [(0, 5.0)], [(NAN, 0)], [(INFINITY, 0)],
                [(True, False)], [(None, 0)], [("0", "1")], [(0,)], [(0, 1, 2)], [(0, 1), (2,)], [[(0, 1)]], [(2**70, 0)],
                [(0, -2**63 - 1)], [(2**63, 0)], np.zeros((1, 2)), np.zeros((1, 2), np.float32), np.zeros((1, 2), bool),
                np.zeros((1, 2), complex), np.zeros((1, 2), object), np.zeros((1, 2), "U1"), np.zeros((1, 2), "M8[s]"),
                np.zeros((2, 1), int), np.zeros((1, 2, 1), int), np.zeros(2, int), np.array(3), np.zeros((1, 3), int),
                np.full((1, 2), 2**64 - 1, np.uint64), np.full((1, 2), 2**31), np.full((1, 2), -2**40), object(), {}, iter(()),
                Nameless(), Broken()]
NO_BLOCKS = [None, 0.7, 3.0, NAN, INFINITY, np.float32(1), True, np.bool_(False), b"stone", 1j, (), [], [1], [[1]], [[[0.5]]],
             [[[1.0]]], [[[True]]], [[[None]]], [[["stone"]]], [[[1, 2], [3]]], [[[2**70]]], [[[[1]]]], np.zeros((1, 1, 1)),
             np.zeros((1, 1, 1), bool), np.zeros((1, 1, 1), object), np.zeros((0, 1, 1), int), np.zeros((1, 1), np.uint16),
             np.zeros((1, 1, 1, 1), np.uint16), np.array(1.0), np.array(True), np.full((1, 1, 1), 2**64 - 1, np.uint64),
             np.full((1, 1, 1), -1), np.full((1, 1, 1), 2**16), -1, 2**16, *HUGE, object(), {}, iter(()), Nameless(), Broken()]
AREA = no_sequences(0, 0, 4, 4) + [(0, 0, 70, 4, 4, element) for element in (7.5, 80.0, NAN, True, None, "9")]
RECTANGLE = no_sequences(0, 0, 2, 2)
INTEGER = NO_INTEGERS + HUGE + [None]
HEIGHT = NO_INTEGERS + HUGE + [-2049, 2049]
STATES = [value for value in NO_BLOCKS if value is not None] + ["stone", np.zeros((1, 1, 2), int), np.zeros((2, 2, 2), int)]
SEED = [value for value in NO_INTEGERS if not isinstance(value, str)]
SEED += [-2**63 - 1, 2**64, 2**70, -2**70, 10**5000, "", "18446744073709551616", "-9223372036854775809", "a\0b", "\ud800"]

# Of each function a call that works, and wrong values of each parameter.
CASES = {
    "World": ({"seed": 1, "generator": "flat", "threads": 1, "content": (), "bottom": -64, "top": None},
              {"seed": SEED + [None], "generator": NO_TEXTS + [None], "threads": INTEGER + [-1, 257], "content": NO_LISTS_OF_TEXTS,
               "bottom": HEIGHT, "top": HEIGHT}),
    "open": ({"world": "none", "read_only": False, "create": False, "seed": 1, "generator": "flat", "threads": 1, "content": (),
              "bottom": None, "top": 512},
             {"world": NO_TEXTS + [None], "read_only": NO_BOOLS, "create": NO_BOOLS, "seed": SEED, "generator": NO_TEXTS,
              "threads": INTEGER + [-1, 257], "content": NO_LISTS_OF_TEXTS, "bottom": HEIGHT, "top": HEIGHT}),
    "generators": ({"content": ()}, {"content": NO_LISTS_OF_TEXTS}),
    "World.block_id": ({"name": "stone"}, {"name": NO_TEXTS + [None]}),
    "World.blocks": ({"area": (0, 0, 4, 4)}, {"area": AREA}),
    "World.states": ({"area": (0, 0, 4, 4)}, {"area": AREA}),
    "World.light": ({"area": (0, 0, 70, 4, 4, 80)}, {"area": AREA}),
    "World.chunk": ({"cx": 0, "cy": 0, "level": 0}, {"cx": INTEGER, "cy": INTEGER, "level": INTEGER + [-1, 16]}),
    "World.chunks": ({"positions": [(0, 0)], "level": 0}, {"positions": NO_POSITIONS, "level": INTEGER + [-1, 16]}),
    "World.digest": ({"chunks": (0, 0, 1, 1)}, {"chunks": RECTANGLE}),
    "World.heights": ({"area": (0, 0, 4, 4), "step": 1, "ground": False},
                      {"area": RECTANGLE, "step": INTEGER + [0, 3, 65536], "ground": NO_BOOLS}),
    "World.surface": ({"area": (0, 0, 4, 4), "step": 1, "ground": False},
                      {"area": RECTANGLE, "step": INTEGER + [0, 3, 65536], "ground": NO_BOOLS}),
    "World.biomes": ({"area": (0, 0, 4, 4), "step": 1}, {"area": RECTANGLE, "step": INTEGER + [0, 3, 65536]}),
    "World.set_blocks": ({"x": 0, "y": 0, "z": 90, "blocks": 1, "states": 0},
                         {"x": INTEGER, "y": INTEGER, "z": INTEGER + [-1, 256], "blocks": NO_BLOCKS, "states": STATES}),
    "World.render": ({"position": (0, 0, 100), "yaw": 0, "pitch": 0, "size": (8, 8), "time": 0.5, "view_distance": 1, "horizon": 0,
                      "preset": "low", "field_of_view": 70},
                     {"position": [None, 1, "", "abc", (), (0, 0), (0, 0, 0, 0), {}, np.zeros((3, 1)), np.zeros((1, 3)), iter(())] +
                                  [(0, 0, wrong) for wrong in NO_NUMBERS] + [(wrong, 0, 0) for wrong in NO_NUMBERS],
                      "yaw": NO_NUMBERS, "pitch": NO_NUMBERS + [91, -90.5], "size": no_sequences(8, 8) + [(0, 1), (1, 8193)],
                      "time": NO_NUMBERS + [-0.1, 1.5], "view_distance": INTEGER + [0, 65], "horizon": INTEGER + [-1, 4097],
                      "preset": NO_TEXTS + [None, "pretty"], "field_of_view": NO_NUMBERS + [0, 171]}),
}
TABLE = [(name, parameter) for name, (_, wrong) in CASES.items() for parameter in wrong]


@pytest.fixture(scope="module")
def world():
    return terrane.World(generator="continents", threads=1)


def called(name, world):
    """The function of a row."""
    return getattr(world, name.split(".")[1]) if "." in name else getattr(terrane, name)


@pytest.mark.parametrize("name,parameter", TABLE)
def test_wrong_values_are_refused_in_one_line(world, name, parameter):
    good, wrong = CASES[name]
    for value in wrong[parameter]:
        if name == "World.render" and not terrane.has_graphics:
            continue
        text = fails("bad_input", called(name, world), **{**good, parameter: value})
        assert text.startswith(f"{parameter}: ") and len(text) < 250, text
        if parameter != "preset" or not isinstance(value, str):
            assert " expected " in text and ", got " in text, text


def test_the_table_has_all_functions_and_parameters():
    stub = ast.parse((pathlib.Path(terrane.__file__).parent / "__init__.pyi").read_text())
    functions = {}
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            functions[node.name] = node
        for method in node.body if isinstance(node, ast.ClassDef) else ():
            if isinstance(method, ast.FunctionDef) and not method.decorator_list:
                functions["World" if method.name == "__init__" else f"World.{method.name}"] = method
    named = {name: {a.arg for a in f.args.args + f.args.kwonlyargs} - {"self"} for name, f in functions.items()
             if not name.startswith("World.__")}
    assert {name: parameters for name, parameters in named.items() if parameters} == {
        name: set(wrong) for name, (_, wrong) in CASES.items()}


@pytest.mark.parametrize("value", INTEGERS, ids=lambda value: type(value).__name__)
def test_integers_of_all_types_are_accepted(world, value):
    assert (world.blocks((0, 0, 0, value, value, value)) == world.blocks((0, 0, 0, 1, 1, 1))).all()
    assert (world.chunk(value, value, value) == world.chunk(1, 1, 1)).all()
    assert (world.chunks([(1, 1)], value) == world.chunks([(1, 1)], 1)).all()
    assert world.digest((0, 0, value, value)) == world.digest((0, 0, 1, 1))
    assert world.heights((0, 0, value, value), value).shape == (1, 1)
    world.set_blocks(value, value, value, value)
    assert world.blocks((1, 1, 1, 2, 2, 2)) == 1
    assert terrane.World(value, "flat", value).threads == 1


@pytest.mark.parametrize("kind", ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">i4", ">u2", "<u8"])
def test_arrays_of_all_types_and_layouts(kind):
    with terrane.World(generator="flat", threads=1) as world:
        ids = np.random.default_rng(1).integers(0, 9, (4, 6, 8)).astype(kind)
        wide = np.zeros((4, 12, 16), kind)
        wide[:, ::2, ::2] = ids
        bytes_before = np.zeros(ids.nbytes + 1, np.uint8)
        shifted = bytes_before[1:].view(kind).reshape(ids.shape)
        shifted[:] = ids
        frozen = ids.copy()
        frozen.flags.writeable = False
        for k, given in enumerate((ids, np.asfortranarray(ids), wide[:, ::2, ::2], ids[::-1][::-1], shifted, frozen,
                                   ids.tolist(), ids.view(np.ndarray))):
            world.set_blocks(0, 0, 100, given, np.asarray(given) if k % 2 else given)
            assert (world.blocks((0, 0, 100, 8, 6, 104)) == ids).all(), k
            assert (world.states((0, 0, 100, 8, 6, 104)) == ids).all(), k
            world.set_blocks(0, 0, 100, np.zeros((4, 6, 8), int))
        positions = np.array([[1, 2], [3, 4], [5, 6]]).astype(kind)
        for given in (positions, np.asfortranarray(positions), np.repeat(positions, 2, 0)[::2], positions[::-1][::-1]):
            assert (world.chunks(given) == world.chunks([(1, 2), (3, 4), (5, 6)])).all()


def test_numbers_and_bools_of_numpy(world):
    assert (world.heights((0, 0, 4, 4), ground=np.bool_(True)) == world.heights((0, 0, 4, 4), ground=True)).all()
    if terrane.has_graphics:
        options = {"size": np.array([8, 8]), "view_distance": np.int64(1), "preset": "low"}
        image = world.render((0, 0, 200), 10, -20, **options)
        assert (world.render(np.array([0, 0, 200.0]), np.float32(10), np.int8(-20), **options) == image).all()
        assert (world.render([np.float64(0), 0, np.uint8(200)], 370, -20, **options) == image).all()


SEEDS = [0, 1, 2**63, 2**64 - 1, -1, -2**63, np.int64(-5), np.uint64(2**64 - 1), "7", "-5", "18446744073709551615", "my world", "0.5",
         "Příliš", " 1"]


@pytest.mark.parametrize("seed", SEEDS, ids=repr)
def test_seeds_are_those_of_the_command_line(program, tmp_path, seed):
    world = terrane.World(seed, "flat", 1)
    assert 0 <= world.seed < 2**64
    if not isinstance(seed, str):
        assert world.seed == int(seed) % 2**64
    assert world.digest((0, 0, 1, 1)) == program("generate", f"--seed={seed}", "--generator=flat", "--area=0,0,1,1", "--digest")
    file = str(tmp_path / "w.sqlite")
    with terrane.open(file, create=True, seed=seed, generator="flat") as saved:
        assert saved.seed == world.seed
    with terrane.open(file, seed=seed) as saved:
        assert saved.seed == world.seed
    assert "seed" in fails("incompatible", terrane.open, file, seed=world.seed ^ 1)


def test_a_text_gives_another_world_than_another_text():
    assert terrane.World("a", "flat").seed != terrane.World("b", "flat").seed
    assert "seed: " in fails("bad_input", terrane.World, "")


WRONG_CALLS = {
    "missing": lambda w: w.blocks(),
    "too many": lambda w: w.blocks((0, 0, 1, 1), 1),
    "keyword-only": lambda w: w.heights((0, 0, 1, 1), 1, True),
    "unknown": lambda w: w.blocks((0, 0, 1, 1), colour=1),
    "odd keyword": lambda w: w.blocks((0, 0, 1, 1), **{"\ud800": 1}),
    "twice": lambda w: w.blocks((0, 0, 1, 1), area=(0, 0, 1, 1)),
    "unknown of World": lambda w: terrane.World(sead=1),
    "too many of World": lambda w: terrane.World(1, "flat", 1, ()),
    "open without a world": lambda w: terrane.open(),
    "open with a position": lambda w: terrane.open("a", True),
    "generators": lambda w: terrane.generators(1, 2),
    "flush": lambda w: w.flush(1),
    "close": lambda w: w.close(1),
    "render": lambda w: w.render(),
    "another self": lambda w: terrane.World.blocks(3, (0, 0, 1, 1)),
    "no self": lambda w: terrane.World.blocks(),
    "a property of another": lambda w: terrane.World.seed.fget(3),
    "a property of none": lambda w: terrane.World.block_names.fget(),
    "not opened": lambda w: terrane.World.__new__(terrane.World).blocks((0, 0, 1, 1)),
    "a property, not opened": lambda w: terrane.World.__new__(terrane.World).seed,
    "repr": lambda w: repr(terrane.World.__new__(terrane.World)),
}


@pytest.mark.parametrize("call", WRONG_CALLS.values(), ids=WRONG_CALLS.keys())
def test_calls_that_do_not_fit_are_type_errors(world, call):
    with pytest.raises(TypeError) as caught:
        call(world)
    text = str(caught.value)
    assert text and "\n" not in text and "incompatible" not in text and "pybind" not in text, text


def test_properties_cannot_be_set(world):
    for name, kind in vars(terrane.World).items():
        if isinstance(kind, property):
            with pytest.raises(AttributeError):
                setattr(world, name, 1)


def test_errors_of_arguments_own_methods_are_theirs(world):
    class Ended(Exception):
        pass

    class Thrower:
        def __index__(self):
            raise Ended

    class Sequence:
        def __len__(self):
            return 4

        def __getitem__(self, k):
            raise Ended

    for call in (lambda: world.chunk(Thrower(), 0), lambda: world.blocks(Sequence()), lambda: world.blocks((0, 0, Thrower(), 1))):
        with pytest.raises(Ended):
            call()


def test_subclasses_work():
    class Mine(terrane.World):
        def __init__(self):
            super().__init__("mine", "flat", 1)

    assert Mine().blocks((0, 0, 1, 1)).shape == (256, 1, 1)

    class Forgotten(terrane.World):
        def __init__(self):  # pylint: disable=super-init-not-called
            pass

    with pytest.raises(TypeError):
        Forgotten()


def test_signatures_can_be_read(world):
    assert str(inspect.signature(terrane.World.heights)) == "(self, area, step=1, *, ground=False)"
    assert str(inspect.signature(world.chunk)) == "(cx, cy, level=0)"
    assert isinstance(terrane.generators, types.BuiltinFunctionType)
    assert list(inspect.signature(terrane.open).parameters)[0] == "world"
