"""How far off a run is, how that falls with the time step, and what it cost.

The measures of this unit:

- ``worst``, ``drift``, ``attitude_error``: a whole run as one number, the largest over its records;
- ``fitted_order``: the slope of log(error) against log(dt), with the rounding plateau left out;
- ``period``: the period of a sampled signal, by interpolated zero crossings;
- ``cpu_seconds``: the processor time of a call; ``front`` and ``time_at``: the best times of several methods.

All errors are in the unit of what is compared, unless a scale is given.

Slides S4, S9, S18; lectures/02_equation_of_motion.md.
"""

import time

import numpy as np
from scipy.interpolate import BarycentricInterpolator
from scipy.optimize import brentq

from .rotation import rotation_angle


def worst(values, exact, scale=1.0):
    """Largest distance between two histories, divided by `scale`.

    values, exact: (T, ..., d), the last axis a vector; returns a float. NaN anywhere gives infinity: a run
    that broke down must never look good.
    """
    gap = np.linalg.norm(np.asarray(values, float) - np.asarray(exact, float), axis=-1)
    largest = float(np.max(gap)) / scale
    return largest if np.isfinite(largest) else np.inf


def attitude_error(orientation, exact):
    """Largest angle (rad) between two histories of attitudes, quaternions (w, x, y, z): (T, …, 4)."""
    orientation, exact = np.asarray(orientation, float), np.asarray(exact, float)
    if not np.all(np.isfinite(orientation)):
        return np.inf
    return float(np.max(rotation_angle(orientation, exact)))


def drift(history):
    """Largest departure of a history (T,) or (T, d) from its first value, relative to it where it isn't 0."""
    history = np.asarray(history, float)
    flat = history.reshape(len(history), -1)
    first = np.linalg.norm(flat[0])
    return worst(flat, flat[:1], scale=first if first > 0 else 1.0)


def fitted_order(dts, errors):
    """Order of convergence p in error ≈ C dtᵖ, from runs at several time steps.

    dts (k,) and errors (k,), in any order. Points where rounding has taken over are left out: going from the
    largest dt down, the fit stops where the local slope falls below half of the steepest so far. Of what is
    left, the finest four points are fitted, since the power law holds for small dt.
    """
    dts, errors = np.asarray(dts, float), np.asarray(errors, float)
    if dts.ndim != 1 or dts.shape != errors.shape or len(dts) < 2:
        raise ValueError(
            f"dts and errors must be two lists of one length, at least 2; got {dts.shape} and {errors.shape}"
        )
    if not np.all(np.isfinite(dts)) or np.any(dts <= 0) or len(set(dts)) < len(dts):
        raise ValueError(f"dts must be positive and different from each other; got {dts}")
    down = np.argsort(-dts)
    dts, errors = dts[down], errors[down]
    kept = _before_plateau(dts, errors)
    if len(kept) < 2:
        raise ValueError(f"no order to fit: fewer than two errors lie above rounding; got errors {errors}")
    return float(np.polyfit(np.log(dts[kept]), np.log(errors[kept]), 1)[0])


def _before_plateau(dts, errors):
    """Indices (at most the finest four) of the points that still follow a power law; dts falling."""
    usable = np.isfinite(errors) & (errors > 0)
    if not usable.any():
        return np.array([], int)
    # An overflow at a coarse step comes first and says nothing; a zero error at a fine one is below rounding.
    kept, steepest = [int(np.argmax(usable))], 0.0
    for i in range(kept[0] + 1, len(errors)):
        if not usable[i]:
            break
        slope = np.log(errors[i - 1] / errors[i]) / np.log(dts[i - 1] / dts[i])
        if slope < max(0.0, steepest / 2):
            break
        steepest = max(steepest, slope)
        kept.append(i)
    beyond = errors[kept[-1] + 1 :]
    # The last points before the plateau hold a share of rounding too: at thirty times its level, some 3 %.
    plateau = 30 * np.median(beyond) if len(beyond) and np.isfinite(beyond).all() else 0.0
    clean = [i for i in kept if errors[i] > plateau]
    return np.array((clean if len(clean) >= 2 else kept)[-4:], int)


def period(time, signal):
    """Period of a signal by its zero crossings: mean time between crossings in the same direction.

    time (T,) rising and signal (T,). Each crossing is the root of the polynomial through the eight samples
    around it, so a smooth signal with twenty or more samples a period gives its period to about 1e-9.
    """
    time, signal = np.asarray(time, float), np.asarray(signal, float)
    if time.ndim != 1 or time.shape != signal.shape:
        raise ValueError(f"time and signal must have one shape (T,); got {time.shape} and {signal.shape}")
    if not np.all(np.isfinite(signal)):
        raise ValueError("signal must be finite; it holds NaN or infinity")
    for direction in (1.0, -1.0):
        times = _crossings(time, direction * signal)
        if len(times) >= 2:
            return float((times[-1] - times[0]) / (len(times) - 1))
    raise ValueError(
        "signal must cross zero at least twice in one direction: give a longer run, or take its mean away"
    )


def _crossings(time, signal, points=8):
    """Times at which the signal goes from below zero to zero or above."""
    found = []
    for i in np.flatnonzero((signal[:-1] < 0) & (signal[1:] >= 0)):
        start = int(np.clip(i - points // 2 + 1, 0, max(0, len(time) - points)))
        near = slice(start, start + points)
        # Shifted and scaled time keeps the interpolation well conditioned far from t = 0.
        step = time[i + 1] - time[i]
        curve = BarycentricInterpolator((time[near] - time[i]) / step, signal[near])
        root = 1.0 if signal[i + 1] == 0 else brentq(curve, 0.0, 1.0, xtol=1e-15, rtol=1e-14)
        found.append(time[i] + root * step)
    return np.array(found)


def cpu_seconds(call, repeats=5, prepare=None, least=2e-3):
    """Processor seconds of one call, the median of `repeats` measurements.

    prepare(): makes the call's argument, outside the clock; without it the call takes none. A call shorter
    than `least` seconds is repeated within each measurement (each with an argument of its own), since some
    systems' clocks tick coarsely. Processor time rather than wall time: a busy machine disturbs it less.
    """
    if repeats < 1:
        raise ValueError(f"repeats must be at least 1; got {repeats}")
    once = _timed(call, prepare, 1)
    number = 1 if once >= least else min(1000, int(least / max(once, 1e-6)) + 1)
    return float(np.median([_timed(call, prepare, number) / number for _ in range(repeats)]))


def _timed(call, prepare, number):
    arguments = [(prepare(),) if prepare else () for _ in range(number)]
    start = time.process_time()
    for argument in arguments:
        call(*argument)
    return time.process_time() - start


def front(points):
    """The best of many (seconds, error): those that no other beats in both, by rising time and falling error.

    points: (k, 2); returns (m, 2). Errors that are not finite are left out, and so are zeros, which have no
    logarithm: give a floor instead.
    """
    points = np.array([p for p in points if np.isfinite(p[1]) and p[1] > 0]).reshape(-1, 2)
    points = points[np.lexsort((points[:, 1], points[:, 0]))]
    best = np.minimum.accumulate(points[:, 1])
    return points[np.append(True, best[1:] < best[:-1])[: len(points)]]


def time_at(curve, error):
    """Seconds that a front needs for an error, by interpolation in both logarithms; infinity where it doesn't
    get there.

    An error looser than all of the front costs what the front's quickest point costs.
    """
    if len(curve) == 0 or error < curve[-1, 1]:
        return np.inf
    seconds = np.interp(-np.log(error), -np.log(curve[:, 1]), np.log(curve[:, 0]))
    return float(np.exp(seconds))
