"""Filter kernels of a list of lights over the reflective shadow map that they were sampled from: which texels they cover, how
often; and the powers of lights."""

import functools
import math

import numpy

import exr


def luminous_powers(found):
    """Luminance of each light's power, both lobes together."""
    lobes = [lobe for lobe in ("diffuse", "specular") if f"power_{lobe}.R" in found]
    return sum(found[f"power_{lobe}.{c}"].astype(float) * weight for lobe in lobes for c, weight in zip("RGB", exr.LUMINANCE))


def squares(lights, size):
    """(x, y, half side, layer) in texels of each light's kernel: a square of 4^level texels about the sampled one."""
    found, _ = exr.read(lights)
    kept = luminous_powers(found) > 0
    texel, level, layer = (found[name][kept] for name in ("texel.I", "level.V", "layer.I"))
    return numpy.stack([texel % size + 0.5, texel // size + 0.5, 2.0 ** level.astype(float) / 2, layer], axis=-1)


def covered(kernels, size):
    """How many kernels cover each texel of the first layer, by its centre's area: parts of texels count as parts."""
    found = numpy.zeros((size, size))
    for x, y, half, layer in kernels:
        if layer != 0:
            continue
        across, down = (numpy.arange(max(0, math.floor(c - half)), min(size, math.ceil(c + half))) for c in (x, y))
        shares = [numpy.minimum(texels + 1, c + half) - numpy.maximum(texels, c - half) for texels, c in ((across, x), (down, y))]
        found[numpy.ix_(down, across)] += numpy.outer(shares[1], shares[0])
    return found


def density(pdf):
    """Of the first layer."""
    return exr.channels(f"{pdf}/pdf.exr", "pdf.V").astype(float)


@functools.cache
def coverage(lights, pdf):
    """Weighted by the density, so that places without light do not count. `gap`: share that no kernel covers; `overlap`: share of
    the kernels' cover beyond the first one of a texel; `worst`: most kernels over one texel; `largest`: share of all texels in
    the largest kernel; `mass_spread`: standard deviation over mean of the density that kernels hold, which is the same for all
    where they fit."""
    weights = density(pdf)
    size = len(weights)
    kernels = squares(f"{lights}/lights.exr", size)
    cover = covered(kernels, size)
    weights = weights / weights.sum()
    total = (weights * cover).sum()
    masses = numpy.array([(weights * covered([kernel], size)).sum() for kernel in kernels if kernel[3] == 0])
    return {"gap": float((weights * numpy.clip(1 - cover, 0, None)).sum()),
            "overlap": float((weights * numpy.clip(cover - 1, 0, None)).sum() / total),
            "worst": float(cover.max()),
            "largest": float((2 * kernels[:, 2]).max() ** 2 / size**2),
            "mass_spread": float(masses.std() / masses.mean())}


@functools.cache
def lights(folder):
    """`brightest`: the largest power of a light over the mean one; `share`: the same over that of all; `spread`: standard
    deviation of powers over their mean; `dimming`: power over area of the quarter with the largest footprints, over that of the
    quarter with the smallest (not a number where footprints are points)."""
    found, _ = exr.read(f"{folder}/lights.exr")
    powers = luminous_powers(found)
    kept = powers > 0
    powers, areas = powers[kept], found["variance.V"][kept].astype(float)
    order = numpy.argsort(areas)
    quarter = max(1, len(order) // 4)
    small, large = (powers[part].sum() / areas[part].sum() if areas[part].sum() > 0 else math.nan
                    for part in (order[:quarter], order[-quarter:]))
    mean = powers.mean()
    return {"brightest": float(powers.max() / mean), "share": float(powers.max() / powers.sum()),
            "spread": float(powers.std() / mean), "dimming": float(large / small)}
