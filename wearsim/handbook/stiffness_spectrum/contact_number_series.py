"""Closed form of the spectrum of the contact number: Bessel coefficients and their convolution.

Golubkov et al. (2016; source document 003). A pitch error that is a sine over the tooth number
modulates the phase of the pulses, so that each harmonic of a wheel's contact function is a sum
of Bessel functions; the product of the two functions is the convolution of their coefficients.
The source's series differs from this in three places, which ``Formula`` names.
"""

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import jv

from wearsim.handbook.stiffness_spectrum.contact_number import Complexes, Floats, GearPair, Wheel

Formula = Literal["corrected", "printed", "printed_argument", "printed_sums", "printed_amplitude"]
"""Corrected; as printed; or one of the source's three slips alone: the argument k beta of the
Bessel functions for n beta; only sums l + p of positive tooth harmonics, no differences; the
coefficient of the two-sided series taken for the amplitude of the cosine."""

_PRINTED_ARGUMENT = ("printed", "printed_argument")
_PRINTED_SUMS = ("printed", "printed_sums")
_PRINTED_AMPLITUDE = ("printed", "printed_amplitude")


def _pulse(wheel: Wheel, contact_ratio: float, n: NDArray[np.integer]) -> Floats:
    """A_n, the coefficient of one tooth's pulse; numpy's sinc is sin(pi x)/(pi x)."""
    duty = contact_ratio / wheel.teeth
    return np.asarray(duty * np.sinc(n * duty))


def bessel_coefficients(
    wheel: Wheel, contact_ratio: float, limit: int, formula: Formula = "corrected"
) -> Complexes:
    """The same coefficients in closed form.

    C(n) = z A_n sum of J_k(n beta) e^(-jk psi) over all k with n + k kappa a multiple l z of the
    teeth: lines at n = l z -+ k kappa, of which the leading one is z A_n J_k(n beta), with
    (-1)^k on one side. Printed are J_k(k beta) and J_0(beta), which is one to two orders less.

    Equation stiffness-spectrum.md (5).

    Parameters
    ----------
    wheel : Wheel
        The wheel.
    contact_ratio : float
        eps.
    limit : int
        Greatest |n|.
    formula : str
        ``printed_argument`` takes the printed argument, ``printed_sums`` only l >= 1 and n = 0,
        ``printed`` both.

    Returns
    -------
    ndarray of complex
        C(n) for n from -limit to limit.
    """
    z, beta = wheel.teeth, wheel.error_angle
    found = np.zeros(2 * limit + 1, dtype=complex)
    for k in range(-(last := _last_order(limit * beta)), last + 1):
        shift = k * wheel.error_order
        n = np.arange(-limit + (limit - shift) % z, limit + 1, z)
        if formula in _PRINTED_SUMS:
            n = n[((n + shift >= z) & (n > 0)) | (n == 0)]
        printed = formula in _PRINTED_ARGUMENT
        argument = np.sign(n) * max(abs(k), 1) * beta if printed else n * beta
        found[n + limit] += jv(k, argument) * np.exp(-1j * k * wheel.error_phase)
    return np.asarray(z * _pulse(wheel, contact_ratio, np.arange(-limit, limit + 1)) * found, complex)


def _last_order(argument: float) -> int:
    """Return the order from which J_k of no greater argument is below rounding."""
    return int(argument + 12.0 * argument ** (1.0 / 3.0) + 20.0) if argument > 0.0 else 0


def series_coefficients(
    pair: GearPair, harmonics: ArrayLike, limit: int, formula: Formula = "corrected"
) -> Complexes:
    """Two-sided Fourier coefficients of the double sum, from those of the wheels.

    S_h = sum of C1(n) C2(m) over n R1 + m R2 = h, |n| and |m| <= limit. The jumps of the pulses
    let it converge as 1/limit only. The source keeps n, m >= 0 only (``printed_sums``).
    """
    first, second = (
        bessel_coefficients(wheel, pair.contact_ratio, limit, formula) for wheel in (pair.pinion, pair.wheel)
    )
    inverse = pow(pair.pinion_turns, -1, pair.wheel_turns)
    found = []
    for h in np.asarray(harmonics, dtype=int).tolist():
        start = (h * inverse + limit) % pair.wheel_turns
        n = np.arange(start, 2 * limit + 1, pair.wheel_turns) - limit
        m = (h - n * pair.pinion_turns) // pair.wheel_turns
        n, m = n[np.abs(m) <= limit], m[np.abs(m) <= limit]
        found.append(first[n + limit] @ second[m + limit])
    return np.array(found, dtype=complex)


def one_sided(coefficients: Complexes, formula: Formula = "corrected") -> Floats:
    """Amplitudes of cosines from two-sided coefficients of lines above 0."""
    return np.asarray((1.0 if formula in _PRINTED_AMPLITUDE else 2.0) * np.abs(coefficients))
