"""How many parameters functions take that are compiled."""

import ast
from pathlib import Path

import flexcage

MOST = 10
ROOMS = ("contacts", "system", "bodies", "solve")
COMPILED = ("kernel", "part", "outlined", "allocating_kernel")
EXEMPT = {
    # grouped otherwise, its inlined sums are taken in another order
    "_face": "pocket.py",
}


def functions_compiled():
    root = Path(flexcage.__file__).parent
    for path in (p for room in ROOMS for p in sorted((root / room).rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef):
                marks = [d.func if isinstance(d, ast.Call) else d for d in node.decorator_list]
                if any(isinstance(m, ast.Name) and m.id in COMPILED for m in marks):
                    yield path.name, node


def test_a_compiled_function_takes_at_most_ten_parameters():
    found = list(functions_compiled())
    assert len(found) > 150
    many = {node.name: name for name, node in found if len(node.args.args) > MOST}
    assert many == EXEMPT
