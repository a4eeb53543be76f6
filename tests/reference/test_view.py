"""Pictures are drawn and described, bad input is told; the pages' figures and tables come from a command."""

import re
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pytest

matplotlib.use("Agg")

from lectures import plots
from reference import Box, Capsule, Disc, Plane, Point, Polygon, Scene, Sphere, simulate, view
from reference.view import charts, drawing

ROOT = Path(__file__).resolve().parents[2]
WORDS = "Two bodies fly and turn."


@pytest.fixture(autouse=True)
def style():
    with view.plt.rc_context():
        view.use_style()
        yield
    view.plt.close("all")


@pytest.fixture(scope="module")
def space():
    scene = Scene(gravity=(0, 0, 0))
    for i, shape in enumerate((Box((0.2, 0.3, 0.4)), Sphere(0.3), Capsule(0.1, 0.2), Point())):
        scene.add(shape, position=(0, i, 0), velocity=(0, 0, 1), group=1)
    scene.spring(0, 3, 1, point_a=(0, 0.3, 0))
    return scene, simulate(scene, 1, 0.25, integrator="splitting")


@pytest.fixture(scope="module")
def plane():
    scene = Scene(gravity=(0, 0))
    for i, shape in enumerate(
        (Box((0.2, 0.3)), Disc(0.3), Capsule(0.1, 0.2), Polygon([(0, 0), (1, 0), (0, 1)]))
    ):
        scene.add(shape, position=(i, 0), angular_velocity=1, group=1)
    scene.add(Plane((0, 1)), position=(0, -1), group=1)
    return scene, simulate(scene, 1, 0.25, integrator="splitting")


# --- pictures -----------------------------------------------------------------------------------------------


def test_show_gives_an_image_with_its_words_and_closes_the_figure():
    figure = view.plt.figure()
    bundle = view.show(figure, 'Two "lines" & more.')._repr_mimebundle_()
    assert 'alt="Two &quot;lines&quot; &amp; more."' in bundle["text/html"]
    assert bundle["text/plain"] == 'Two "lines" & more.'
    assert bundle["image/png"].startswith("iVBOR")  # a PNG, in base64
    assert not view.plt.fignum_exists(figure.number)


@pytest.mark.parametrize("alt", ["", "figure", None, "two words"])
def test_show_wants_words(alt):
    with pytest.raises(ValueError, match="alt must say in words"):
        view.show(view.plt.figure(), alt)


def test_the_same_picture_has_the_same_bytes(space):
    first, second = (view.show(view.key_frames(*space, frames=2), WORDS).png for _ in range(2))
    assert first == second


def test_lines_differ_in_colour_and_in_dashes():
    assert len(set(charts.COLOURS)) == len(set(charts.DASHES)) == 8


# --- charts -------------------------------------------------------------------------------------------------


def test_convergence_draws_a_line_a_name_and_guides_of_the_right_slope():
    h = np.array([0.1, 0.05, 0.025, 0.0125])
    axes = view.plot_convergence(h, {"euler": h, "rk4": h**4}, guides={"rk4": 4})
    assert [line.get_label() for line in axes.lines[:2]] == ["euler", "rk4"]
    x, y = axes.lines[2].get_data()
    assert np.allclose(np.diff(np.log(y)) / np.diff(np.log(x)), 4)
    assert "(s)" in axes.get_xlabel()


@pytest.mark.parametrize(
    ("dts", "errors", "message"),
    [
        ([0.1, -0.1], {"a": [1, 2]}, "dts must be"),
        ([], {"a": []}, "dts must be"),
        ([0.1], {}, "errors must be"),
        ([0.1, 0.2], {"a": [1]}, r"errors\['a'\] must have the shape"),
    ],
)
def test_convergence_tells_bad_input(dts, errors, message):
    with pytest.raises(ValueError, match=message):
        view.plot_convergence(dts, errors)


def test_series_may_have_times_of_their_own():
    axes = view.plot_series([0, 1], {"a": [1, 2], "b": ([0, 1, 2], [3, 2, 1])}, "height (m)")
    assert [len(line.get_xdata()) for line in axes.lines] == [2, 3]
    assert axes.get_ylabel() == "height (m)"
    with pytest.raises(ValueError, match=r"series\['a'\] must have the shape"):
        view.plot_series([0, 1], {"a": [1, 2, 3]}, "height (m)")


def test_energy_is_relative_to_the_start(space):
    axes = view.plot_energy({"run": space[1]})
    energy = space[1].energy()
    assert np.allclose(axes.lines[0].get_ydata(), abs(energy / energy[0] - 1), atol=1e-16)
    assert axes.get_yscale() == "log"


# --- bodies -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [Box((0.2, 0.3, 0.4)), Sphere(0.3), Capsule(0.1, 0.2)])
def test_faces_in_space_look_outwards_and_close_the_surface(shape):
    polygons, colours = drawing.faces(shape, 3)
    assert len(polygons) == len(colours)
    normals = []
    for polygon in polygons:
        normal = sum(np.cross(a, b) for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)) / 2
        assert normal @ polygon.mean(axis=0) > -1e-15
        normals.append(normal)
    assert np.allclose(sum(normals), 0)  # a closed surface's area vectors sum to nothing


@pytest.mark.parametrize(
    ("shape", "width", "height"), [(Disc(2), 4, 4), (Capsule(1, 2), 2, 6), (Box((1, 2)), 2, 4)]
)
def test_outlines_in_the_plane_have_the_shapes_size(shape, width, height):
    size = np.ptp(drawing.faces(shape, 2)[0][0], axis=0)
    assert np.allclose(size, (width, height), rtol=0.01)


def test_draw_space(space):
    axes = view.draw(*space, k=0, view=(0, 0))
    assert len(axes.collections) == 4  # one a body, empty for the point
    spring = axes.lines[-1].get_xydata()  # seen along −x: y to the right, z up
    assert np.allclose(spring, [(0.3, 0), (3, 0)])
    assert axes.get_xlabel() == "right (m)"
    assert "t = 0 s" in axes.get_title()


def test_a_box_shows_the_faces_that_look_at_the_viewer(space):
    axes = view.draw(*space, k=0, view=(0, 0))
    sides = [len(collection.get_paths()) for collection in axes.collections]
    assert 1 in sides  # straight from the front one sees one face of the box


def test_draw_plane_with_paths(plane):
    axes = view.draw(*plane, path=True)
    assert axes.get_xlabel() == "x (m)"
    assert len(axes.lines) == 5 + 1  # a path a body, and the ground


@pytest.mark.parametrize("k", [5, -6])
def test_draw_tells_a_record_that_is_not_there(space, k):
    with pytest.raises(ValueError, match="k must be the number of a record, 0 … 4"):
        view.draw(*space, k=k)


def test_key_frames_spread_over_the_run(space):
    titles = [axes.get_title() for axes in view.key_frames(*space, frames=3).axes]
    assert titles == ["t = 0 s", "t = 0.5 s", "t = 1 s"]
    with pytest.raises(ValueError, match="frames must be a number from 1 to 12"):
        view.key_frames(*space, frames=0)


def test_an_animation_has_key_frames_words_and_no_link(plane):
    page = view.animate(*plane, WORDS, frames=3, key=2)._repr_mimebundle_()["text/html"]
    assert page.startswith(f'<img alt="{WORDS}"')
    assert page.count("<img") == 1 + 3
    assert page.count("display:none") == 2
    assert 'type="range"' in page
    assert "http" not in page  # all of it is in the page


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ({"frames": 1}, "frames must be"),
        ({"frames": 2.5}, "frames must be"),
        ({"seconds": 0}, "seconds must be"),
    ],
)
def test_an_animation_tells_bad_input(space, bad, message):
    with pytest.raises(ValueError, match=message):
        view.animate(*space, WORDS, **bad)


# --- the lecture pages' figures and tables ------------------------------------------------------------------


def numbered(names, number):
    return {name for name in names if name.startswith(f"{number}_")}


@pytest.mark.slow
@pytest.mark.parametrize("slug", plots.units())
def test_figures_and_tables_of_a_page_come_from_the_command(slug, tmp_path):
    number = slug.split("_")[0]
    command = [sys.executable, "lectures/figures.py", number, "--out", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=True, encoding="utf-8")
    drawn = {file.name for file in tmp_path.iterdir()}
    page = (ROOT / "lectures" / f"{slug}.md").read_text(encoding="utf-8")
    assert drawn == numbered({file.name for file in (ROOT / "lectures" / "figures").iterdir()}, number)
    assert drawn == set(re.findall(r"\]\(figures/([\w.]+)\)", page))
    for row in (line for line in done.stdout.splitlines() if line.startswith("|")):
        assert row in page.splitlines(), "a table on the page is not what the command prints"


def test_every_figure_of_the_pages_is_drawn_by_the_command():
    there = {file.name for file in (ROOT / "lectures" / "figures").iterdir()}
    assert there and there == set().union(*(numbered(there, slug.split("_")[0]) for slug in plots.units()))
    done = subprocess.run([sys.executable, "lectures/figures.py", "99"], cwd=ROOT, capture_output=True)
    assert done.returncode and b"there is no unit '99'" in done.stderr
