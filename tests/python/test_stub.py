"""Keywords are read one by one in C++: the stub, the docstring and the module must know the same ones."""

import ast
import pathlib
import re

import atlas_refine
import pytest

STUB = ast.parse((pathlib.Path(atlas_refine.__file__).parent / "_atlas_refine.pyi").read_text())
FUNCTIONS = {node.name: node.args for node in STUB.body if isinstance(node, ast.FunctionDef)}


def call(name, /, **keywords):
    """The function on empty arrays."""
    result = getattr(atlas_refine, name)([], [], [], [], **keywords)
    return result.result() if isinstance(result, atlas_refine.Job) else result


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_keyword_and_default_of_the_stub_is_taken(name):
    for keyword, default in zip(FUNCTIONS[name].kwonlyargs, FUNCTIONS[name].kw_defaults, strict=True):
        with pytest.raises(atlas_refine.AtlasRefineError) as caught:
            call(name, **{keyword.arg: ast.literal_eval(default)})
        assert caught.value.code == "bad_input", keyword.arg


@pytest.mark.parametrize("name", ["refine", "start"])
def test_every_keyword_is_documented(name):
    arguments = FUNCTIONS[name]
    documented = re.findall(r"^([a-z_]+) {2,}\S", getattr(atlas_refine, name).__doc__, re.MULTILINE)
    assert documented
    assert sorted(documented) == sorted(argument.arg for argument in arguments.args + arguments.kwonlyargs)
