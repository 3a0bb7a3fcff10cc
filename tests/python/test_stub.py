"""Keywords are read one by one in C++: the stub, the docstring and the module must know the same ones."""

import ast
import pathlib
import re

import atlas_refine
import pytest

STUB = ast.parse((pathlib.Path(atlas_refine.__file__).parent / "_atlas_refine.pyi").read_text())
FUNCTIONS = {node.name: node.args for node in STUB.body if isinstance(node, ast.FunctionDef)}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_keyword_and_default_of_the_stub_is_taken(name):
    arguments = FUNCTIONS[name]
    for keyword, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
        call = {keyword.arg: ast.literal_eval(default)}
        try:
            outcome = getattr(atlas_refine, name)([], [], [], [], **call)
            outcome.result()
        except atlas_refine.AtlasRefineError as error:
            assert error.code == "bad_input", call
        else:
            pytest.fail(f"{call}: empty arrays are taken")


@pytest.mark.parametrize("name", ["refine", "start"])
def test_every_keyword_is_documented(name):
    arguments = FUNCTIONS[name]
    documented = re.findall(r"^([a-z_]+) {2,}\S", getattr(atlas_refine, name).__doc__, re.MULTILINE)
    assert documented
    assert sorted(documented) == sorted(argument.arg for argument in arguments.args + arguments.kwonlyargs)
