# SPDX-License-Identifier: BSD-3-Clause
"""The type stubs name what the module has, with the same arguments; everything has a docstring."""
import ast
import inspect
import pathlib
import unittest

import catena

STUB = ast.parse(pathlib.Path(catena.__file__).with_suffix(".pyi").read_text())


def arguments(function):
    given = function.args
    return [a.arg for a in given.posonlyargs + given.args + given.kwonlyargs if a.arg != "self"]


class Stubs(unittest.TestCase):
    def test_the_same_names(self):
        stubbed = {
            node.name for node in STUB.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))
        }
        self.assertEqual(stubbed, set(catena.__all__))

    def test_the_same_members(self):
        for node in STUB.body:
            if not isinstance(node, ast.ClassDef) or node.name.endswith("Error"):
                continue
            stubbed = {
                item.target.id if isinstance(item, ast.AnnAssign) else item.name
                for item in node.body
                if isinstance(item, (ast.FunctionDef, ast.AnnAssign))
            } - {"__init__"}
            real = {name for name in vars(getattr(catena, node.name)) if not name.startswith("_")}
            real |= set(vars(getattr(catena, node.name)).get("__annotations__", ()))
            self.assertEqual(stubbed, real, node.name)

    def test_the_same_arguments(self):
        for node in STUB.body:
            if isinstance(node, ast.FunctionDef):
                signature = getattr(catena, node.name).__doc__.splitlines()[0]
                for argument in arguments(node):
                    self.assertIn(f"{argument}:", signature, node.name)

    def test_docstrings(self):
        for name in catena.__all__:
            self.assertTrue(inspect.getdoc(getattr(catena, name)), name)


if __name__ == "__main__":
    unittest.main()
