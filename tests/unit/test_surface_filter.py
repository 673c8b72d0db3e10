"""Smoothing of measured profiles."""

import math

import numpy as np
import pytest

from wearsim.geometry.measured.surface_filter import filter_stations, gaussian_weights


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 4.0])
def test_a_wave_keeps_the_amplitude_that_the_standard_says(ratio):
    """Transmission exp(-pi (alpha lambda_c/lambda)^2), ISO 16610-21."""
    places = np.linspace(-20.0, 20.0, 20001)
    weights = gaussian_weights(places, np.array([0.0]), 0.8)
    kept = float((weights @ np.cos(2.0 * math.pi * places / (0.8 * ratio)))[0])
    alpha = math.sqrt(math.log(2.0) / math.pi)
    assert kept == pytest.approx(math.exp(-math.pi * (alpha / ratio) ** 2), abs=1e-9)


def test_a_straight_line_stays_inside_and_a_constant_everywhere():
    places = np.linspace(0.0, 10.0, 1001)
    stations = np.array([0.0, 5.0, 10.0])
    weights = gaussian_weights(places, stations, 0.8)
    assert weights @ np.full(1001, 3.0) == pytest.approx(3.0)
    assert float((weights @ places)[1]) == pytest.approx(5.0, abs=1e-12)


def test_a_station_far_from_all_points_takes_the_nearest_one():
    weights = gaussian_weights(np.array([0.0, 1.0]), np.array([50.0]), 0.01)
    assert weights.tolist() == [[0.0, 1.0]]


def test_stations_lie_a_cut_off_apart_where_there_are_points():
    places = np.concatenate([np.linspace(0.0, 2.99, 300), np.linspace(7.0, 8.0, 101)])
    stations = filter_stations(places, 1.0)
    assert stations == pytest.approx([0.5, 1.5, 2.5, 7.5], abs=0.02)
    assert filter_stations(np.array([2.0]), 1.0).tolist() == [2.0]
