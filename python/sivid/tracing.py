# SPDX-License-Identifier: MIT
"""Functions of Python as equations.

A function is called once with names in place of numbers, and what it computes becomes the equations of a model text
(``sivid-model-1``), which the reader of models checks as any other: units, domains, names. Nothing of the function is
called later.
"""
from __future__ import annotations

import decimal
import numbers
import re

import numpy as np

__all__ = ["Expression", "Condition", "clamp", "deadband", "number", "where"]

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*$")
_DEEPEST = 40  # of 60 that the reader takes
_LONGEST = 4000  # of 10 000 characters that a line may have
_FUNCTIONS = "abs, sign, minimum, maximum, sqrt, square, exp, log, sin, cos, tan, arctan, tanh, clip and where"


class Expression:
    """What a traced function computes with: operators of Python, functions of numpy, ``where`` and ``clamp``.

    Numbers in it mean what they are: ``0.1`` is the double next to a tenth, ``"0.1"`` is a tenth, ``"9.81 m/s^2"`` has
    a unit. A comparison gives a condition for ``sivid.where``; ``if`` cannot see it and is refused.
    """

    __slots__ = ("form", "of", "number")
    __hash__ = object.__hash__
    _made = 0

    def __init__(self, form: str, *of: "Expression"):
        """``form``: the text with {0}, {1}, ... for operands, or a name or number where there are none."""
        self.form = form
        self.of = of
        Expression._made += 1
        self.number = Expression._made

    def __repr__(self) -> str:
        return f"<traced {self.form.format(*('...' for _ in self.of)) if self.of else self.form}>"

    def __add__(self, other):
        return _binary("{0} + {1}", self, other)

    def __radd__(self, other):
        return _binary("{0} + {1}", other, self)

    def __sub__(self, other):
        return _binary("{0} - {1}", self, other)

    def __rsub__(self, other):
        return _binary("{0} - {1}", other, self)

    def __mul__(self, other):
        return _binary("{0}*{1}", self, other)

    def __rmul__(self, other):
        return _binary("{0}*{1}", other, self)

    def __truediv__(self, other):
        return _binary("{0}/{1}", self, other)

    def __rtruediv__(self, other):
        return _binary("{0}/{1}", other, self)

    def __neg__(self):
        return Expression("-{0}", self)

    def __pos__(self):
        return self

    def __abs__(self):
        return Expression("abs({0})", self)

    def __pow__(self, exponent):
        if isinstance(exponent, Expression):
            raise TypeError("the power of a traced value is a number: write np.exp(y*np.log(x)) for x**y")
        if exponent == 0.5:
            return Expression("sqrt({0})", self)
        if exponent != int(exponent) or not -32 <= exponent <= 32:
            raise TypeError(
                f"the power {exponent} is no whole number from -32 to 32: write np.exp({exponent}*np.log(x))"
            )
        return Expression("{0}^" + str(int(exponent)), self)

    def __rpow__(self, base):
        raise TypeError("a number to a traced power: write np.exp(x*np.log(number))")

    def __lt__(self, other):
        return Condition(self, "<", _operand(other))

    def __le__(self, other):
        return Condition(self, "<=", _operand(other))

    def __gt__(self, other):
        return Condition(self, ">", _operand(other))

    def __ge__(self, other):
        return Condition(self, ">=", _operand(other))

    def __eq__(self, other):
        raise TypeError(
            "traced values are not compared by ==: they are numbers that vary; compare by < or > in sivid.where"
        )

    __ne__ = __eq__

    def __bool__(self):
        raise TypeError("the truth of a traced value is not known when the model is made: use sivid.where(a > b, x, y)")

    def _no_number(self, *_):
        raise TypeError(
            "a traced value is no number: use functions of numpy, np.sin instead of math.sin; "
            "there are " + _FUNCTIONS
        )

    __float__ = __int__ = __index__ = __round__ = __floordiv__ = __rfloordiv__ = __mod__ = __rmod__ = _no_number

    def __array_ufunc__(self, ufunc, method, *inputs, **kwargs):
        form = _UFUNCS.get(ufunc.__name__)
        if method != "__call__" or kwargs or form is None:
            raise TypeError(
                f"np.{ufunc.__name__}{'' if method == '__call__' else '.' + method} of a traced value: "
                "there are " + _FUNCTIONS
            )
        if any(isinstance(x, np.ndarray) and x.ndim > 0 for x in inputs):
            raise TypeError("a traced value is one number: write an equation for each element of an array")
        if callable(form):
            return form(*inputs)
        return Expression(form, *(_operand(x) for x in inputs))

    def __array_function__(self, function, types, args, kwargs):
        if function is np.where and len(args) == 3 and not kwargs:
            return where(*args)
        if function is np.clip and len(args) == 3 and not kwargs:
            return clamp(*args)
        raise TypeError(f"np.{function.__name__} of a traced value: there are " + _FUNCTIONS)

    def clip(self, low, high):
        """What ``np.clip`` calls."""
        return clamp(self, low, high)


class Condition:
    """A comparison of traced values, for ``sivid.where`` alone."""

    __slots__ = ("left", "sign", "right")

    def __init__(self, left: Expression, sign: str, right: Expression):
        self.left, self.sign, self.right = left, sign, right

    def __bool__(self):
        raise TypeError(
            "a comparison of traced values is not decided when the model is made: "
            "use sivid.where(a > b, x, y) in place of if, np.minimum and np.maximum in place of min and max"
        )

    def __array_function__(self, function, types, args, kwargs):
        if function is np.where and len(args) == 3 and not kwargs:
            return where(*args)
        raise TypeError(f"np.{function.__name__} of a comparison of traced values: use sivid.where(a > b, x, y)")

    def _alone(self, *_):
        raise TypeError("conditions are not joined: put one sivid.where into the other")

    __and__ = __rand__ = __or__ = __ror__ = __invert__ = _alone


def number(text: str) -> Expression:
    """A decimal with or without a unit: ``number("0.1")`` is a tenth, ``number("9.81 m/s^2")`` has a unit."""
    found = _NUMBER.match(text)
    if not found:
        raise ValueError(
            f"{text!r} is no number: write a decimal such as \"0.1\", and its unit behind it, \"9.81 m/s^2\""
        )
    digits, unit = found.groups()
    form = digits.lstrip("+-") + (f" [{unit}]" if unit else "")
    return Expression("-{0}", Expression(form)) if digits.startswith("-") else Expression(form)


def where(condition: Condition, x, y) -> Expression:
    """x where the condition holds, y elsewhere, and all between x and y where both sides of it are equal."""
    if not isinstance(condition, Condition):
        raise TypeError("where takes a comparison of traced values, as in sivid.where(v > 0, x, y)")
    return Expression(
        "if({0} " + condition.sign + " {1}, {2}, {3})", condition.left, condition.right, _operand(x), _operand(y)
    )


def clamp(x, low, high) -> Expression:
    """x between low and high."""
    return Expression("clamp({0}, {1}, {2})", _operand(x), _operand(low), _operand(high))


def deadband(x, width) -> Expression:
    """x without what lies within the width of 0."""
    return Expression("deadband({0}, {1})", _operand(x), _operand(width))


def _binary(form: str, a, b):
    if isinstance(a, np.ndarray) and a.ndim > 0 or isinstance(b, np.ndarray) and b.ndim > 0:
        raise TypeError("a traced value is one number: write an equation for each element of an array")
    return Expression(form, _operand(a), _operand(b))


def _operand(x) -> Expression:
    if isinstance(x, Expression):
        return x
    if isinstance(x, str):
        return number(x)
    if isinstance(x, Condition):
        raise TypeError("a comparison is no number: use sivid.where(a > b, 1, 0)")
    if isinstance(x, np.ndarray) and x.ndim == 0:
        x = x.item()
    if isinstance(x, bool) or not isinstance(x, (numbers.Real, decimal.Decimal)):
        raise TypeError(f"{x!r} is no number that an equation can have")
    exact = (
        decimal.Decimal(int(x))
        if isinstance(x, numbers.Integral)
        else (x if isinstance(x, decimal.Decimal) else decimal.Decimal(float(x)))
    )
    if not exact.is_finite():
        raise ValueError(f"{x!r} is no finite number")
    text = format(exact, "f")
    if len(text) > 40:
        text = format(exact, "e").replace("e+", "e")
    return number(text)


def _ufunc(name):
    return lambda x: Expression(name + "({0})", _operand(x))


_UFUNCS = {
    "add": "{0} + {1}",
    "subtract": "{0} - {1}",
    "multiply": "{0}*{1}",
    "divide": "{0}/{1}",
    "true_divide": "{0}/{1}",
    "negative": "-{0}",
    "positive": lambda x: x,
    "absolute": "abs({0})",
    "fabs": "abs({0})",
    "sign": "sign({0})",
    "minimum": "min({0}, {1})",
    "fmin": "min({0}, {1})",
    "maximum": "max({0}, {1})",
    "fmax": "max({0}, {1})",
    "sqrt": "sqrt({0})",
    "square": "sqr({0})",
    "exp": "exp({0})",
    "log": "log({0})",
    "sin": "sin({0})",
    "cos": "cos({0})",
    "tan": "tan({0})",
    "arctan": "atan({0})",
    "tanh": "tanh({0})",
    "reciprocal": lambda x: 1 / x,
    "power": lambda x, n: x ** n if isinstance(x, Expression) else n.__rpow__(x),
    "float_power": lambda x, n: x ** n if isinstance(x, Expression) else n.__rpow__(x),
    "less": lambda a, b: _operand(a) < b,
    "less_equal": lambda a, b: _operand(a) <= b,
    "greater": lambda a, b: _operand(a) > b,
    "greater_equal": lambda a, b: _operand(a) >= b,
    "equal": lambda a, b: _operand(a) == b,
    "not_equal": lambda a, b: _operand(a) != b,
}


class Names:
    """States, inputs or constants of a model, traced: ``x.speed``, ``x["speed"]``, or in their order ``a, b = x``."""

    def __init__(self, kind: str, names):
        self._kind = kind
        self._all = {name: Expression(name) for name in names}

    def __getitem__(self, name):
        if isinstance(name, int):
            return list(self._all.values())[name]
        if name not in self._all:
            raise KeyError(f"there is no {self._kind} {name!r}; there are: {', '.join(self._all) or 'none'}")
        return self._all[name]

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError as unknown:
            raise AttributeError(unknown.args[0]) from None

    def __iter__(self):
        return iter(self._all.values())

    def __contains__(self, name):
        return name in self._all

    def __len__(self):
        return len(self._all)


class Writer:
    """Writes traced values as formulas, in the order in which they were computed: the graph that is recorded of the
    text has its operations in that order, as the graph of a functor has.

    A value that is used once stands within the formula that uses it, where that keeps the order; others become named
    parts of the model.
    """

    def __init__(self, taken, roots):
        self.parts: list[tuple[str, str]] = []
        self._taken = set(taken)
        self._uses: dict[int, int] = {}
        self._text: dict[int, tuple[str, int, bool]] = {}  # formula, depth, whether it is one word
        self._open: list[Expression] = []  # computed, not written yet
        self._write(roots)

    def formula(self, x: Expression) -> str:
        """Of one of the roots."""
        return self._text[x.number][0]

    def _write(self, roots):
        nodes: dict[int, Expression] = {}
        stack = list(roots)
        for root in roots:
            self._uses[root.number] = self._uses.get(root.number, 0) + 1
        while stack:
            x = stack.pop()
            if x.number in nodes:
                continue
            nodes[x.number] = x
            for y in x.of:
                self._uses[y.number] = self._uses.get(y.number, 0) + 1
                stack.append(y)
        for _, x in sorted(nodes.items()):
            self._compute(x)
        left = [x.number for x in self._open]
        if left != [x.number for x in roots if x.number in left]:
            self._name_open()

    def _compute(self, x: Expression):
        if not x.of:
            self._text[x.number] = (x.form, 0, " " not in x.form)
            return
        waiting = [y for y in x.of if any(y is z for z in self._open)]
        if waiting and not all(a is b for a, b in zip(self._open[-len(waiting) :], waiting)):
            self._name_open()
            waiting = []
        if waiting:
            del self._open[-len(waiting) :]
        texts = [self._text[y.number] for y in x.of]
        call = x.form[0].isalpha()
        text = x.form.format(*(t if call or word else f"({t})" for t, _, word in texts))
        depth = 1 + max(d for _, d, _ in texts)
        self._text[x.number] = (text, depth, call)
        self._open.append(x)
        if self._uses[x.number] > 1 or depth > _DEEPEST or len(text) > _LONGEST:
            self._name_open()

    def _name_open(self):
        """Names all that is computed and not written yet, in its order."""
        for x in self._open:
            name = f"part_{len(self.parts) + 1}"
            while name in self._taken:
                name += "_"
            self.parts.append((name, self._text[x.number][0]))
            self._text[x.number] = (name, 0, True)
        self._open = []
