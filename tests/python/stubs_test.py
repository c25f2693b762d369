"""The types in __init__.pyi against the package itself."""
import ast
import inspect
import pathlib

import terrane

STUB = ast.parse((pathlib.Path(terrane.__file__).parent / "__init__.pyi").read_text())


def names_of(body):
    """Functions, classes and annotated names by name."""
    return {n.name if hasattr(n, "name") else n.target.id: n for n in body
            if isinstance(n, (ast.FunctionDef, ast.ClassDef)) or (isinstance(n, ast.AnnAssign) and n.simple)}


def signature_of(function):
    """The stub's signature without annotations."""
    arguments = function.args
    for a in arguments.posonlyargs + arguments.args + arguments.kwonlyargs:
        a.annotation = None
    return ast.unparse(arguments)


def public(thing):
    return {name for name in dir(thing) if not name.startswith("_")}


def test_the_package_has_what_the_stub_says():
    stub = set(names_of(STUB.body))
    assert {n for n in stub if not n.startswith("_")} == set(terrane.__all__)
    assert public(terrane) - set(terrane.__all__) == set()
    assert (pathlib.Path(terrane.__file__).parent / "py.typed").exists()


def test_worlds_have_what_the_stub_says():
    stub = names_of(names_of(STUB.body)["World"].body)
    assert {n for n in stub if not n.startswith("_")} == public(terrane.World)


def test_signatures_are_those_of_the_stub():
    for owner, body in ((terrane, STUB.body), (terrane.World, names_of(STUB.body)["World"].body)):
        for name, node in names_of(body).items():
            if isinstance(node, ast.FunctionDef) and not node.decorator_list:
                signature = str(inspect.signature(getattr(owner, name)))
                assert signature.replace(" = ", "=") == f"({signature_of(node)})", name


def test_every_public_name_has_a_description():
    for name in set(terrane.__all__) - {"has_graphics"}:
        assert len(inspect.getdoc(getattr(terrane, name))) > 20, name
    for name in public(terrane.World):
        text = inspect.getdoc(getattr(terrane.World, name))
        assert text and len(text.split("\n\n")[-1]) > 20, name
    assert "terrane.World" in terrane.__doc__


def test_arrays_say_their_types():
    for name, kind in (("blocks", "uint16"), ("states", "uint16"), ("chunk", "uint16"), ("light", "uint8"), ("heights", "int16"),
                       ("surface", "uint16"), ("biomes", "uint8")):
        assert kind in getattr(terrane.World, name).__doc__
