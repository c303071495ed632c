"""Radiance of a lit sphere, as [Sloan 2007] approximates it, against its definition by quadrature: what figures 4 and 5 show. The
tools have the same in libs/sh, tested on its own."""

import numpy

PI = numpy.pi
COSINE = numpy.array([PI, 2 * PI / 3, PI / 4])  # factors of the convolution with the clamped cosine, by band
CONSTANTS = {(0, 0): 1 / 4, (1, 0): 3 / 4, (1, 1): 3 / 4, (2, 0): 5 / 16, (2, 1): 15 / 4, (2, 2): 15 / 16}  # squared, times pi
SINES = (numpy.arange(200) + 0.5) / 200


def basis(l, m, x, z):
    """y_lm, m >= 0, at azimuth 0."""
    shapes = {(0, 0): 1, (1, 0): z, (1, 1): x, (2, 0): 3 * z**2 - 1, (2, 1): x * z, (2, 2): x**2}
    return numpy.sqrt(CONSTANTS[l, m] / PI) * shapes[l, m] * numpy.ones_like(x)


def sights(sine):
    """Directions to a sphere at half angle asin(sine), the sphere's normals there, and weights that sum to 1 - cos."""
    nodes, weights = numpy.polynomial.legendre.leggauss(40)
    v = sine * (1 + nodes) / 2
    z = numpy.sqrt(1 - sine**2 + v**2)
    r = numpy.sqrt(numpy.maximum(sine**2 - v**2, 0))
    return (r, z), ((z - v) * r / sine, (v**2 - sine**2 - v * z) / sine), weights * sine / 2 * v / z


def mean_emission(sine):
    """D(theta), Eq. (14)."""
    _, normal, weights = sights(sine)
    return numpy.array([weights @ basis(l, 0, *normal) for l in range(3)]) / weights.sum()


def polynomials(sine):
    """The paper's fits of D: the tools take D itself."""
    return numpy.array([0.28209, (0.08432 * sine - 0.25073) * sine - 0.32494, ((-0.22230 * sine + 0.22502) * sine + 0.47398) * sine + 0.15950])


def exact(sine):
    """M(theta), Eq. (16): (m, band of the radiance, band of the irradiance)."""
    direction, normal, weights = sights(sine)
    matrix = numpy.zeros((3, 3, 3))
    for m in range(3):
        for j in range(m, 3):
            for k in range(m, 3):
                matrix[m, j, k] = (2 * PI if m == 0 else PI) * weights @ (basis(j, m, *direction) * basis(k, m, *normal))
    return matrix


def operator_error(sine, averaged):
    """Frobenius norm of the difference from the exact operator on the environment, over that one's."""
    direction, _, weights = sights(sine)
    cap = numpy.array([2 * PI * weights @ basis(j, 0, *direction) for j in range(3)])
    emission = mean_emission(sine) if averaged else numpy.array([basis(k, 0, numpy.zeros(1), -numpy.ones(1))[0] for k in range(3)])
    truth = exact(sine) * COSINE
    found = numpy.zeros_like(truth)
    found[0] = numpy.outer(cap, emission * COSINE)
    twice = numpy.array([1, 2, 2])[:, None, None]  # m and -m
    return float(numpy.sqrt((twice * (found - truth) ** 2).sum() / (twice * truth**2).sum()))


def fit_error(band):
    """Relative squared error of the polynomial of a band."""
    true, fit = (numpy.array([function(sine)[band] for sine in SINES]) for function in (mean_emission, polynomials))
    return float(((true - fit) ** 2).sum() / (true**2).sum())


def best_fit_error(band, degree):
    """The same of the polynomial of that degree that has the least."""
    true = numpy.array([mean_emission(sine)[band] for sine in SINES])
    fit = numpy.polyval(numpy.polyfit(SINES, true, degree), SINES)
    return float(((true - fit) ** 2).sum() / (true**2).sum())


MEASURES = {
    "best_linear_fit": lambda: best_fit_error(1, 2),
    "best_quadratic_fit": lambda: best_fit_error(2, 3),
    "linear_fit": lambda: fit_error(1),
    "quadratic_fit": lambda: fit_error(2),
    "point": lambda: float(numpy.mean([operator_error(sine, False) for sine in SINES])),
    "averaged": lambda: float(numpy.mean([operator_error(sine, True) for sine in SINES])),
}


def curves(name):
    """Label -> values at SINES: "fit", the bands of D; "error", that of the operators."""
    if name == "error":
        return {label: [operator_error(sine, averaged) for sine in SINES] for label, averaged in (("point", False), ("averaged", True))}
    true, fit = (numpy.array([function(sine) for sine in SINES]) for function in (mean_emission, polynomials))
    return {"linear, negative": -true[:, 1], "its quadratic fit": -fit[:, 1], "quadratic": true[:, 2], "its cubic fit": fit[:, 2]}
