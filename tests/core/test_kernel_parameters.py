"""What holds for every function that is compiled: few parameters, and places with names."""

import ast
from collections.abc import Iterator
from pathlib import Path

import flexcage

MOST = 10
ROOMS = ("contacts", "system", "bodies", "solve", "bearings")
COMPILED = ("kernel", "part", "outlined", "allocating_kernel")
COUNTED = {
    "factor": "bordered.py",  # rows of six, unrolled
    "_block_by_block": "pocket_wall.py",  # eight neighbours, unrolled
}


def functions_compiled():
    root = Path(flexcage.__file__).parent
    for path in (p for room in ROOMS for p in sorted((root / room).rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef):
                marks = [d.func if isinstance(d, ast.Call) else d for d in node.decorator_list]
                if any(isinstance(m, ast.Name) and m.id in COMPILED for m in marks):
                    yield path.name, node


def nameless(function: ast.AST) -> set[str]:
    """Subscripts with a place beyond the third that is a bare number, alone or as the begin of a
    block (``3 + c``, ``3 : 6``). A neighbour's distance (``k + 3``) needs no name, and 0, 1, 2 are
    the axes of a vector, or of two or three things of a kind."""
    return {
        ast.unparse(sub)
        for sub in ast.walk(function)
        if isinstance(sub, ast.Subscript)
        for index in indices(sub.slice)
        if isinstance(index, ast.Constant) and type(index.value) is int and index.value > 2
    }


def indices(index: ast.expr) -> Iterator[ast.expr]:
    """An index, its parts, or what it begins with."""
    if isinstance(index, ast.Tuple):
        for element in index.elts:
            yield from indices(element)
    elif isinstance(index, ast.Slice):
        for end in (index.lower, index.upper):
            if end is not None:
                yield from indices(end)
    elif isinstance(index, ast.BinOp):
        yield from indices(index.left)
    else:
        yield index


def test_a_compiled_function_takes_at_most_ten_parameters():
    found = list(functions_compiled())
    assert len(found) > 150
    assert {node.name: name for name, node in found if len(node.args.args) > MOST} == {}


def test_places_beyond_a_vectors_three_have_names_in_compiled_functions():
    counted = {(node.name, name): nameless(node) for name, node in functions_compiled()}
    assert {k: v for k, v in counted.items() if v and k not in COUNTED.items()} == {}


def test_the_search_for_bare_numbers_finds_them():
    code = "f[3], g[i, 4], h[3 + c], p[3:6], q[i, 3 * j + k]"
    assert len(nameless(ast.parse(code))) == 5
    assert not nameless(ast.parse("f[2], g[TURN + 1], h[k + 3], p[TURN:MODES], q[-1], d['a']"))
