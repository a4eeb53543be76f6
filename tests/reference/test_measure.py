"""The measures themselves, on made-up histories whose answers are known."""

import numpy as np
import pytest

from reference import measure


def test_fitted_order_of_an_exact_power_law():
    dts = 0.1 / 2.0 ** np.arange(6)
    for order in (1, 2, 4, 6):
        assert measure.fitted_order(dts, 3 * dts**order) == pytest.approx(order, abs=1e-9)


def test_fitted_order_leaves_the_rounding_plateau_out():
    rng = np.random.default_rng(1)
    dts = 0.1 / 2.0 ** np.arange(12)
    errors = 5 * dts**4 + 1e-12 * rng.uniform(0.5, 2, len(dts))
    assert measure.fitted_order(dts, errors) == pytest.approx(4, abs=0.05)
    shuffled = rng.permutation(len(dts))
    assert measure.fitted_order(dts[shuffled], errors[shuffled]) == pytest.approx(4, abs=0.05)


def test_fitted_order_survives_overflow_and_exact_zeros():
    dts = 0.1 / 2.0 ** np.arange(6)
    errors = dts**2
    errors[0], errors[-1] = np.inf, 0.0
    assert measure.fitted_order(dts, errors) == pytest.approx(2, abs=1e-9)


@pytest.mark.parametrize(
    ("dts", "errors", "word"),
    [
        ([0.1], [1.0], "at least 2"),
        ([0.1, 0.2], [1.0, 2.0, 3.0], "one length"),
        ([0.1, -0.1], [1.0, 2.0], "positive"),
        ([0.1, 0.1], [1.0, 2.0], "different"),
        ([0.1, 0.05], [0.0, 0.0], "no order to fit"),
    ],
)
def test_fitted_order_refuses_what_has_no_order(dts, errors, word):
    with pytest.raises(ValueError, match=word):
        measure.fitted_order(dts, errors)


@pytest.mark.parametrize("samples", [20, 33, 200])
def test_period_of_a_smooth_signal(samples):
    true = 1.2345678
    time = np.arange(0, 8 * true, true / samples)
    signal = np.sin(2 * np.pi * time / true + 0.3)
    found = measure.period(time, signal)
    # Eight-point interpolation of a sine: its error falls with the eighth power of the spacing.
    assert found == pytest.approx(true, rel=1e-9 if samples >= 33 else 1e-6)


def test_period_needs_two_crossings_and_finite_numbers():
    time = np.linspace(0, 1, 50)
    with pytest.raises(ValueError, match="at least twice"):
        measure.period(time, 1 + time)
    with pytest.raises(ValueError, match="finite"):
        measure.period(time, np.full(50, np.nan))
    with pytest.raises(ValueError, match="one shape"):
        measure.period(time, time[1:])


def test_period_takes_a_crossing_that_is_a_sample():
    time = np.arange(0, 9) / 4
    assert measure.period(time, np.array([-1.0, 0, 1, 0, -1, 0, 1, 0, -1])) == pytest.approx(1.0)


def test_worst_and_drift():
    exact = np.zeros((5, 2, 3))
    values = exact.copy()
    values[3, 1] = 3.0, 4.0, 0.0
    assert measure.worst(values, exact) == 5
    assert measure.worst(values, exact, scale=10) == 0.5
    values[4, 0, 0] = np.nan
    assert measure.worst(values, exact) == np.inf
    assert measure.drift(np.array([2.0, 2.1, 1.8])) == pytest.approx(0.1)
    assert measure.drift(np.array([0.0, 0.3])) == pytest.approx(0.3)
    assert measure.drift(np.array([[3.0, 4.0], [3.0, 4.5]])) == pytest.approx(0.1)


def test_attitude_error_sees_tiny_angles_and_no_sign():
    half = 1e-9 / 2
    turned = np.array([[np.cos(half), np.sin(half), 0, 0]])
    straight = np.array([[1.0, 0, 0, 0]])
    assert measure.attitude_error(turned, straight) == pytest.approx(1e-9, rel=1e-6)
    assert measure.attitude_error(-turned, straight) == pytest.approx(1e-9, rel=1e-6)
    assert measure.attitude_error(np.full((1, 4), np.nan), straight) == np.inf


def test_cpu_seconds_leaves_preparing_out():
    def busy(n):
        return sum(i * i for i in range(n))

    def prepare():
        busy(60_000)
        return 2_000

    short = measure.cpu_seconds(busy, repeats=5, prepare=prepare)
    long = measure.cpu_seconds(busy, repeats=5, prepare=lambda: 60_000)
    assert 0 < 5 * short < long
    with pytest.raises(ValueError, match="repeats"):
        measure.cpu_seconds(busy, repeats=0)


def test_front_and_time_at():
    points = [(1.0, 1e-1), (2.0, 1e-2), (2.5, 1e-1), (4.0, 1e-2), (8.0, 1e-4), (3.0, np.inf), (0.5, np.nan)]
    front = measure.front(points)
    np.testing.assert_array_equal(front, [(1.0, 1e-1), (2.0, 1e-2), (8.0, 1e-4)])
    assert measure.time_at(front, 1e-1) == pytest.approx(1.0)
    assert measure.time_at(front, 1.0) == pytest.approx(1.0)
    assert measure.time_at(front, 1e-3) == pytest.approx(4.0)
    assert measure.time_at(front, 1e-5) == np.inf
    assert measure.time_at(measure.front([]), 1e-5) == np.inf
