"""Proves that frame letters chain: ``python tools/frame_letters.py lpcal`` (folders or files), exit 1 on a mistake.

A name states its frames: ``H_AB`` and ``R_AB`` take B to A, ``x_A``, ``axis_A``, ``points_A_true`` are points or directions in A.
Over the syntax tree, without running anything::

    H_AB @ H_BC -> AC     inv(H_AB) -> BA     apply(H_AB, x_B), rotate(H_AB, v_B), R_AB @ v_B -> A
    H_AB[..., :3, :3] -> R_AB                 H_AB[..., :3, 3] -> A               v_B @ R_BA -> A

and whatever is assigned, passed or returned under a name with letters must carry those letters. A name without letters is left alone,
and so is all that comes of it. A function one of whose parameters has the letter A holds for any frames: its letters bind no caller.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

FRAMES = "OPDCBL"
GENERIC = "A"
TRANSFORM = re.compile(rf"(?:^|_)([HR])_([{FRAMES}{GENERIC}])([{FRAMES}{GENERIC}])(?:_|$)")
VECTOR = re.compile(rf"^_?[a-z]\w*?_([{FRAMES}{GENERIC}])(?:_[a-z0-9]+)*$")
NOT_A_FRAME = re.compile(r"covariance|sigma|std|jacobian|information", re.IGNORECASE)
SAME_AS_FIRST = {"asarray", "array", "ascontiguousarray", "atleast_2d", "broadcast_to", "copy", "stack", "concatenate", "vstack", "mean"}
SAME_AS_FIRST |= {"median", "average", "squeeze", "reshape", "repeat", "interpolate", "list", "tuple", "sorted"}
SAME_AS_OWNER = {"copy", "reshape", "mean", "astype", "squeeze"}


class Letters(NamedTuple):
    """Frames of a value: a transform (H), a rotation (R) from `source` to `frame`, or a vector (x) in `frame`."""

    kind: str
    frame: str
    source: str = ""

    def __str__(self) -> str:
        return f"{self.kind}_{self.frame}{self.source}"


def letters_of(name: str) -> Letters | None:
    """What a name says of its frames."""
    if NOT_A_FRAME.search(name):
        return None
    if found := TRANSFORM.search(name):
        return Letters(*found.groups())
    found = VECTOR.match(name)
    return Letters("x", found[1]) if found else None


def name_of(node: ast.expr | None) -> str:
    """Last name of a variable, an attribute or a string key; empty where there is none."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return name
        case ast.Constant(value=str(name)) if name.isidentifier():
            return name
    return ""


class Checker(ast.NodeVisitor):
    """Collects the mistakes of one file."""

    def __init__(self, path: str, parameters: dict[str, list[str]]) -> None:
        self.path, self.parameters, self.functions = path, parameters, [""]
        self.mistakes: dict[str, None] = {}

    def report(self, node: ast.AST, found: str, expected: str) -> None:
        self.mistakes[f"{self.path}:{getattr(node, 'lineno', 1)}: found {found}, expected {expected}"] = None

    def compare(self, name: str, value: ast.expr | None, place: ast.AST, wanted: Letters | None = None) -> None:
        """The value that goes by a name must carry its letters."""
        wanted, found = wanted or letters_of(name), self.infer(value)
        if wanted and found and wanted != found and not (wanted.kind == "x" and wanted.frame == found.frame):
            self.report(place, f"{found} for {name}", str(wanted))

    def bind(self, target: ast.expr, value: ast.expr | None, *, loop: bool = False) -> None:
        if isinstance(target, (ast.Tuple, ast.List)):
            if loop and isinstance(value, ast.Call):
                values = {"zip": value.args, "enumerate": [None, *value.args]}.get(name_of(value.func), [])
            else:
                values = value.elts if isinstance(value, (ast.Tuple, ast.List)) and not loop else []
            for one, its_value in zip(target.elts, values, strict=False):
                self.bind(one, its_value, loop=loop)
        else:
            self.compare(ast.unparse(target), value, target, self.infer(target))

    def visit(self, node: ast.AST) -> None:
        match node:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self.bind(target, value)
            case ast.AnnAssign(target=target, value=value) | ast.NamedExpr(target=target, value=value):
                self.bind(target, value)
            case ast.AugAssign(target=target, op=op, value=value):
                self.bind(target, ast.copy_location(ast.BinOp(target, op, value), node))
            case ast.For(target=target, iter=value) | ast.comprehension(target=target, iter=value):
                self.bind(target, value, loop=True)
            case ast.Dict(keys=keys, values=values):
                for key, value in zip(keys, values, strict=True):
                    self.compare(name_of(key), value, value)
            case ast.Return(value=value):
                self.compare(self.functions[-1], value, node)
            case ast.FunctionDef(name=name):
                self.functions.append(name)
                self.generic_visit(node)
                self.functions.pop()
                return
            case ast.Call():
                self.call(node)
        if isinstance(node, ast.expr):
            self.infer(node)
        self.generic_visit(node)

    def call(self, node: ast.Call) -> None:
        for keyword in node.keywords:
            if GENERIC not in (keyword.arg or "").rpartition("_")[2]:
                self.compare(keyword.arg or "", keyword.value, keyword.value)
        for name, value in zip(self.parameters.get(name_of(node.func), []), node.args, strict=False):
            self.compare(name, value, value)

    def infer(self, node: ast.expr | None) -> Letters | None:
        """Frames of an expression; None where they cannot be known."""
        match node:
            case ast.Attribute(value=owner, attr="T" | "mT"):
                return self.turned(node, self.infer(owner))
            case ast.Name() | ast.Attribute():
                return letters_of(name_of(node))
            case ast.Subscript(value=owner, slice=index):
                return letters_of(name_of(index)) if isinstance(index, ast.Constant) and name_of(index) else self.part(owner, index)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                found = self.infer(operand)
                return found if found and found.kind == "x" else None
            case ast.BinOp(left=left, op=op, right=right):
                return self.operation(node, op, self.infer(left), self.infer(right))
            case ast.List(elts=elements) | ast.Tuple(elts=elements):
                return self.agreed([self.infer(element) for element in elements])
            case ast.ListComp(elt=element) | ast.GeneratorExp(elt=element) | ast.Starred(value=element):
                return self.infer(element)
            case ast.IfExp(body=body, orelse=orelse):
                return self.agreed([self.infer(body), self.infer(orelse)])
            case ast.Call(func=function, args=arguments):
                return self.result(node, function, arguments)
        return None

    def agreed(self, found: list[Letters | None]) -> Letters | None:
        return found[0] if found and len(set(found)) == 1 else None

    def part(self, owner: ast.expr, index: ast.expr) -> Letters | None:
        whole = self.infer(owner)
        if whole is None or whole.kind == "x":
            return whole
        steps = [ast.unparse(step) for step in index.elts] if isinstance(index, ast.Tuple) else [ast.unparse(index)]
        match whole.kind, steps[-2:]:
            case "H", [":3", ":3"]:
                return whole._replace(kind="R")
            case ("H", [":3", ("0" | "1" | "2" | "3" | "3:" | "-1")]) | ("R", [(":" | "..."), ("0" | "1" | "2")]):
                return Letters("x", whole.frame)
            case "R", [":", ":"]:
                return whole
        one = index.elts[0] if isinstance(index, ast.Tuple) and len(steps) == 1 else index
        return whole if not isinstance(one, (ast.Tuple, ast.Slice)) or steps == [":"] else None

    def turned(self, node: ast.AST, found: Letters | None) -> Letters | None:
        if found and found.kind == "H":
            return self.report(node, f"the transpose of {found}", f"se3.inv({found}): a transform's transpose is not its inverse")
        return Letters(found.kind, found.source, found.frame) if found and found.kind == "R" else found

    def operation(self, node: ast.AST, op: ast.operator, left: Letters | None, right: Letters | None) -> Letters | None:
        if isinstance(op, (ast.Mult, ast.Div)) and (left is None) != (right is None):
            one = left or (right if isinstance(op, ast.Mult) else None)
            return one if one and one.kind == "x" else None
        if left is None or right is None:
            return None
        if left.kind == right.kind == "x":
            if left.frame != right.frame:
                return self.report(node, f"{left} and {right} together", "vectors in one frame")
            return left if isinstance(op, (ast.Add, ast.Sub)) else None
        return self.chained(node, left, right) if isinstance(op, ast.MatMult) else None

    def chained(self, node: ast.AST, left: Letters, right: Letters) -> Letters | None:
        """``left @ right``; a vector on the left is a row, so that the rotation goes from `frame` to `source`."""
        inner = left.frame if left.kind == "x" else left.source
        if inner != right.frame:
            return self.report(node, f"{left} @ {right}", f"{left} @ {right.kind}_{inner}{right.source and '?'}")
        if left.kind == "x":
            return Letters("x", right.source)
        return Letters(right.kind, left.frame, right.source) if right.kind in {"x", left.kind} else None

    def result(self, node: ast.Call, function: ast.expr, arguments: list[ast.expr]) -> Letters | None:
        name, found = name_of(function), [self.infer(argument) for argument in arguments]
        first = found[0] if found else None
        match name, found:
            case "inv", [Letters(kind=kind, frame=frame, source=source)] if source:
                return Letters(kind, source, frame)
            case (("apply" | "rotate"), [Letters(kind="H") as H, Letters(kind="x") as x, *_]):
                return self.chained(node, H, x)
            case (("apply" | "rotate"), [Letters(kind="H") as H, None, *_]):
                return Letters("x", H.frame)
            case "transform", [Letters(kind="R") as R, t]:
                if t and t.frame != R.frame:
                    self.report(node, f"transform({R}, {t})", f"a translation in {R.frame}")
                return R._replace(kind="H")
            case "cross", [Letters(kind="x") as a, Letters(kind="x") as b, *_]:
                return self.operation(node, ast.Add(), a, b)
            case (("swapaxes" | "transpose" | "matrix_transpose"), _):
                return self.turned(node, first)
        if isinstance(function, ast.Attribute) and name in SAME_AS_OWNER and name_of(function.value) not in {"np", "se3"}:
            return self.infer(function.value)
        return first if name in SAME_AS_FIRST else letters_of(name)


def files(paths: list[str]) -> Iterator[Path]:
    for path in map(Path, paths):
        yield from sorted(path.rglob("*.py")) if path.is_dir() else [path]


def parameters_of(trees: list[ast.Module]) -> dict[str, list[str]]:
    """Positional parameters of functions, and fields of records, that hold for fixed frames; of several of one name, what they agree on."""
    found: dict[str, list[str]] = {}
    for node in (node for tree in trees for node in ast.walk(tree)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names = [argument.arg for argument in (*node.args.posonlyargs, *node.args.args) if argument.arg not in {"self", "cls"}]
        elif isinstance(node, ast.ClassDef) and any("dataclass" in ast.unparse(one) for one in node.decorator_list):
            names = [name_of(one.target) for one in node.body if isinstance(one, ast.AnnAssign)]
        else:
            continue
        if any(GENERIC in letters for letters in map(letters_of, names) if letters):
            names = []
        found[node.name] = [a if a == b else "" for a, b in zip(found.get(node.name, names), names, strict=False)]
    return found


def check(sources: dict[str, str]) -> list[str]:
    """Mistakes, a line each, of sources by path."""
    trees = {path: ast.parse(source, path) for path, source in sources.items()}
    parameters = parameters_of(list(trees.values()))
    mistakes: list[str] = []
    for path, tree in trees.items():
        checker = Checker(path, parameters)
        checker.visit(tree)
        mistakes += checker.mistakes
    return mistakes


def main(paths: list[str]) -> int:
    """Print the mistakes; 1 if there is one, 2 if there is nothing to check."""
    sources = {str(path): path.read_text(encoding="utf-8") for path in files(paths)}
    if not sources:
        print("usage: frame_letters.py FOLDER_OR_FILE...", file=sys.stderr)
        return 2
    mistakes = check(sources)
    print("\n".join(mistakes) if mistakes else f"frame letters chain in {len(sources)} files")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
