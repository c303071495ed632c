#!/usr/bin/env python3
"""Prints shaders/proxy/sh_product.glsl: the product of two functions given by their spherical harmonics of order 4, straight on.
tests/unit/soft_gi compares it with libs/sh."""

import itertools

import numpy

ORDER, POINTS, AZIMUTHS = 4, 8, 16  # exact for the products of three polynomials of degree 3
LINE = 150

HEAD = """// Made by configs/shaders/sh_product.py: the projected product of two functions given by their spherical harmonics of order 4, from
// the 77 integrals of three basis functions that are not 0. `h` must be another array than `f` and `g`.
#ifndef VSGL_PROXY_SH_PRODUCT_GLSL
#define VSGL_PROXY_SH_PRODUCT_GLSL

void sh_product(float f[16], float g[16], out float h[16]) {
"""


def basis(x, y, z):
    def k(square):
        return numpy.sqrt(square / (4 * numpy.pi))
    rows = [k(1) * numpy.ones_like(x), k(3) * y, k(3) * z, k(3) * x, k(15) * x * y, k(15) * y * z, k(5 / 4) * (3 * z**2 - 1), k(15) * x * z,
            k(15 / 4) * (x**2 - y**2), k(35 / 8) * y * (3 * x**2 - y**2), k(105) * x * y * z, k(21 / 8) * y * (5 * z**2 - 1),
            k(7 / 4) * z * (5 * z**2 - 3), k(21 / 8) * x * (5 * z**2 - 1), k(105 / 4) * z * (x**2 - y**2), k(35 / 8) * x * (x**2 - 3 * y**2)]
    return numpy.array(rows)


def triples():
    """T[i, j, k], the integral of y_i y_j y_k over the sphere."""
    heights, weights = numpy.polynomial.legendre.leggauss(POINTS)
    angles = 2 * numpy.pi * (numpy.arange(AZIMUTHS) + 0.5) / AZIMUTHS
    z, angle = [grid.ravel() for grid in numpy.meshgrid(heights, angles, indexing="ij")]
    r = numpy.sqrt(1 - z**2)
    y = basis(r * numpy.cos(angle), r * numpy.sin(angle), z)
    return numpy.einsum("in,jn,kn,n->ijk", y, y, y, numpy.repeat(weights, AZIMUTHS) * 2 * numpy.pi / AZIMUTHS)


def terms(t, k):
    """Summands of coefficient k; those of one factor together."""
    groups = {}
    for i, j in itertools.combinations_with_replacement(range(ORDER**2), 2):
        value = round(t[i, j, k], 9)
        if abs(value) > 1e-9:
            pair = f"f[{i}] * g[{j}]" if i == j else f"f[{i}] * g[{j}] + f[{j}] * g[{i}]"
            groups.setdefault(abs(value), []).append((value > 0, pair))
    for factor, pairs in groups.items():
        text = ""
        for positive, pair in sorted(pairs, reverse=True):
            sign = "+" if positive else "-"
            body = pair if positive or "+" not in pair else f"({pair})"
            text += f" {sign} {body}" if text else (body if positive else f"-{body}" if body[0] == "(" else f"-({body})")
        yield f"{factor:.9g} * ({text})"


def main():
    t = triples()
    print(HEAD, end="")
    for k in range(ORDER**2):
        line = f"  h[{k}] ="
        for n, term in enumerate(terms(t, k)):
            piece = f" {term}" if n == 0 else f" + {term}"
            if len(line) + len(piece) > LINE:
                print(line)
                line = "      "
            line += piece
        print(line + ";")
    print("}\n\n#endif")


main()
