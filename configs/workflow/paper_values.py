"""Arithmetic and placeholders of the papers' figures: what a text says with figures, and what a claim compares."""

import ast
import math
import operator
import string

OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
             ast.USub: operator.neg, ast.Lt: operator.lt, ast.LtE: operator.le, ast.Gt: operator.gt, ast.GtE: operator.ge}
FUNCTIONS = {"min": min, "max": max, "abs": abs}


class BadExpression(Exception):
    """Not the arithmetic that a figure may use, or a name that it does not measure."""


def names(expression):
    """The measured figures that the expression uses, in order."""
    tree = _parse(expression)
    found = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id not in FUNCTIONS]
    return list(dict.fromkeys(found))


def evaluate(expression, values):
    """A number, or True or False. values: name -> number."""
    try:
        return _evaluate(_parse(expression).body, values)
    except ZeroDivisionError:
        return math.nan


def placeholders(text):
    """The measured figures that the text shows."""
    try:
        return [field for _, field, _, _ in string.Formatter().parse(text) if field is not None]
    except ValueError as error:
        raise BadExpression(f"\"{text}\": {error}") from error


def without_placeholders(text):
    return "".join(literal for literal, _, _, _ in string.Formatter().parse(text))


def fill(text, values):
    return text.format(**values)


def _parse(expression):
    try:
        return ast.parse(expression, mode="eval")
    except SyntaxError as error:
        raise BadExpression(f"\"{expression}\": {error.msg}") from error


def _evaluate(node, values):
    match node:
        case ast.Constant(value=int() | float() as value):
            return value
        case ast.Name(id=name) if name in values:
            return values[name]
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_evaluate(operand, values))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATORS:
            return OPERATORS[type(op)](_evaluate(left, values), _evaluate(right, values))
        case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in OPERATORS for op in ops):
            terms = [_evaluate(term, values) for term in (left, *others)]
            return all(OPERATORS[type(op)](a, b) for op, a, b in zip(ops, terms, terms[1:]))
        case ast.BoolOp(op=op, values=terms):
            results = [_evaluate(term, values) for term in terms]
            return all(results) if isinstance(op, ast.And) else any(results)
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](*(_evaluate(arg, values) for arg in args))
    raise BadExpression(f"\"{ast.unparse(node)}\": neither arithmetic nor a measured figure; there are {', '.join(values)}")
