"""Filter kernels of a list of lights over the reflective shadow map that they were sampled from: which texels they cover, how often."""

import functools
import math

import numpy

import exr


def squares(lights, size):
    """(x, y, half side, layer) in texels of each light's kernel: a square of 4^level texels about the sampled one."""
    found, _ = exr.read(lights)
    kept = found["power_diffuse.R"] + found["power_diffuse.G"] + found["power_diffuse.B"] > 0
    if "power_specular.R" in found:
        kept = kept | (found["power_specular.R"] + found["power_specular.G"] + found["power_specular.B"] > 0)
    texel, level, layer = (found[name][kept] for name in ("texel.I", "level.V", "layer.I"))
    return numpy.stack([texel % size + 0.5, texel // size + 0.5, 2.0 ** level.astype(float) / 2, layer], axis=-1)


def covered(kernels, size):
    """How many kernels cover each texel of the first layer, by its centre's area: parts of texels count as parts."""
    found = numpy.zeros((size, size))
    for x, y, half, layer in kernels:
        if layer != 0:
            continue
        along = [numpy.clip(numpy.minimum(numpy.arange(size) + 1, c + half) - numpy.maximum(numpy.arange(size), c - half), 0, 1)
                 for c in (x, y)]
        first = [max(0, math.floor(c - half)) for c in (x, y)]
        last = [min(size, math.ceil(c + half)) for c in (x, y)]
        found[first[1]:last[1], first[0]:last[0]] += numpy.outer(along[1][first[1]:last[1]], along[0][first[0]:last[0]])
    return found


def density(pdf):
    """Of the first layer."""
    return exr.channels(f"{pdf}/pdf.exr", "pdf.V").astype(float)


@functools.cache
def coverage(lights, pdf):
    """Weighted by the density, so that places without light do not count. `gap`: share that no kernel covers; `overlap`: share of the
    kernels' cover beyond the first one of a texel; `worst`: most kernels over one texel; `largest`: share of all texels in the
    largest kernel; `mass_spread`: standard deviation over mean of the density that kernels hold, which is the same for all where
    they fit."""
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
    """`brightest`: the largest power of a light over the mean one; `spread`: standard deviation of powers over their mean."""
    found, _ = exr.read(f"{folder}/lights.exr")
    powers = sum(found[f"power_{lobe}.{c}"].astype(float) * weight for lobe in ("diffuse", "specular") if f"power_{lobe}.R" in found
                 for c, weight in zip("RGB", (0.2126, 0.7152, 0.0722)))
    powers = powers[powers > 0]
    return {"brightest": float(powers.max() / powers.mean()), "spread": float(powers.std() / powers.mean())}
