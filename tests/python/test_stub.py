"""The stub has the names and signatures of the module, and everything in the module has a docstring."""

import ast
import inspect
import unittest

import shagreen
from support import ROOT

STUB = ROOT / "crates" / "python" / "shagreen.pyi"
# Types of dictionaries, which only the stub has.
DICTIONARIES = {"Tap"}
BY_NAME_OR_PLACE, BY_NAME = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY


def is_public(name):
    return not name.startswith("_")


def in_stub(function):
    """Name, kind and whether there is a default of each parameter, without self."""
    given = function.args
    n_required = len(given.args) - len(given.defaults)
    placed = [(one.arg, BY_NAME_OR_PLACE, index >= n_required) for index, one in enumerate(given.args)]
    named = [(one.arg, BY_NAME, value is not None) for one, value in zip(given.kwonlyargs, given.kw_defaults)]
    return [one for one in placed + named if one[0] != "self"]


def in_module(function):
    """The same of a function of the module."""
    parameters = inspect.signature(function).parameters.values()
    has_default = inspect.Parameter.empty
    return [(one.name, one.kind, one.default is not has_default) for one in parameters if one.name != "self"]


class Stub(unittest.TestCase):
    """Each line of the stub beside what it describes."""

    @classmethod
    def setUpClass(cls):
        body = ast.parse(STUB.read_text(encoding="utf-8")).body
        cls.classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
        cls.functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}

    def check(self, name, described, function):
        self.assertTrue(inspect.getdoc(function), f"{name} has no docstring")
        found, expected = in_module(function), in_stub(described)
        if [kind for _, kind, _ in found] == [inspect.Parameter.VAR_KEYWORD]:
            # The names are checked when the function is called.
            self.assertTrue(all(kind == BY_NAME and optional for _, kind, optional in expected), name)
        else:
            self.assertEqual(found, expected, name)

    def test_names(self):
        public = {name for name in filter(is_public, dir(shagreen)) if not inspect.ismodule(getattr(shagreen, name))}
        self.assertEqual(public, (self.classes.keys() | self.functions.keys()) - DICTIONARIES)
        self.assertTrue(shagreen.__version__ and shagreen.__doc__)

    def test_functions(self):
        self.assertGreater(len(self.functions), 8)
        for name, described in self.functions.items():
            with self.subTest(name=name):
                self.check(name, described, getattr(shagreen, name))

    def test_classes(self):
        for name in self.classes.keys() - DICTIONARIES:
            of_module = getattr(shagreen, name)
            self.assertTrue(of_module.__doc__, f"{name} has no docstring")
            members = {node.name: node for node in self.classes[name].body if isinstance(node, ast.FunctionDef)}
            self.assertEqual(set(filter(is_public, vars(of_module))), set(filter(is_public, members)), name)
            for member, described in members.items():
                with self.subTest(name=f"{name}.{member}"):
                    decorators = {one.id for one in described.decorator_list}
                    found = vars(of_module).get(member)
                    if not is_public(member):
                        self.assertTrue(hasattr(of_module, member))
                    elif "property" in decorators:
                        self.assertTrue(inspect.isdatadescriptor(found) and inspect.getdoc(found))
                    else:
                        self.assertEqual(isinstance(found, staticmethod), "staticmethod" in decorators)
                        self.check(f"{name}.{member}", described, getattr(of_module, member))

    def test_the_comparison_can_fail(self):
        def made(a, b=1, *, c=2):
            return a, b, c

        same, other = (ast.parse(f"def made({text}) -> int: ...").body[0] for text in ["a, b=1, *, c=2", "a, b, *, c=2"])
        self.assertEqual(in_stub(same), in_module(made))
        self.assertNotEqual(in_stub(other), in_module(made))
        # The controls of a shape are those that the module knows.
        controls = [name for name, _, _ in in_stub(next(self.members("Texture", "shaped")))]
        cork = shagreen.load_library()["cork"]
        for control in controls:
            neutral = 1.0 if control in {"grain", "softness", "friction", "relief"} else 0.0
            self.assertIsInstance(cork.shaped(**{control: neutral}), shagreen.Texture)

    def members(self, name, member):
        return (node for node in self.classes[name].body if getattr(node, "name", None) == member)
