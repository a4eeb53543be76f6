"""Every link leads somewhere, and slide, page, notebook, module and exercise name one another."""

from pathlib import PurePosixPath

import pytest

from tests.house import sample
from tests.house.links import anchors, back_faults, index_faults, link_faults, links, page_faults
from tests.house.sample import BODIES, EXERCISE, LESSON, PAGE, SLUG, edit
from tests.house.tree import ROOT, UNITS, pages

WRITTEN = pages(ROOT)


def test_there_is_something_to_test():
    assert WRITTEN


def test_links_lead_somewhere():
    assert link_faults(ROOT) == []


@pytest.mark.parametrize("slug", WRITTEN)
def test_page_names_its_slides_modules_notebook_and_exercise(slug):
    assert page_faults(ROOT, slug) == []


def test_notebooks_exercises_and_modules_name_their_page():
    assert back_faults(ROOT) == []


def test_index_lists_all_units():
    assert index_faults(ROOT) == []


# --- the rules themselves -----------------------------------------------------------------------------------


@pytest.fixture
def root(tmp_path):
    return sample.plant(tmp_path)


def all_faults(root):
    units = [fault for slug in pages(root) for fault in page_faults(root, slug)]
    return link_faults(root) + units + back_faults(root) + index_faults(root)


def test_a_good_tree_has_no_faults(root):
    assert all_faults(root) == []
    assert len(UNITS) == 16


NEXT = "01 taxonomy (not yet written)"
PLANTED = {
    "file gone": (PAGE, "(ball.svg)", "(bell.svg)", "leads nowhere"),
    "wrong capitals": (PAGE, "(ball.svg)", "(Ball.svg)", "leads nowhere"),
    "anchor gone": (PAGE, "## One step", "## A step", "names a place"),
    "label gone": (PAGE, "(eq-step)=", "(eq-stop)=", "names a place"),
    "anchor of another file": ("README.md", "index.md", "index.md#nothing", "names a place"),
    "absolute": (PAGE, "(ball.svg)", "(/lectures/ball.svg)", "make it relative"),
    "out of the tree": (PAGE, "(ball.svg)", "(../../shared/ball.svg)", "leaves the repository"),
    "http": (PAGE, "(ball.svg)", "(http://example.org/ball.svg)", "not https"),
    "https without a host": (PAGE, "(ball.svg)", "(https://ball)", "not https"),
    "file scheme": (PAGE, "(ball.svg)", "(file:ball.svg)", "not https"),
    "no alt text": (PAGE, "![A ball falls along a parabola]", "![]", "no words"),
    "defined link": (PAGE, "Slides S4", "[x]: nowhere.md\n\nSlides S4", "leads nowhere"),
    "picture in a directive": (
        PAGE,
        "Slides S4",
        "```{figure} gone.svg\n:alt: A picture\n```\nSlides S4",
        "leads nowhere",
    ),
    "directive without alt": (PAGE, "Slides S4", "```{figure} ball.svg\nCaption\n```\nSlides S4", "no words"),
    "html picture": (PAGE, "Slides S4", '<img src="ball.svg">\n\nSlides S4', "no words"),
    "link in a note": (PAGE, "Slides S4", "```{note}\n[x](gone.md)\n```\nSlides S4", "leads nowhere"),
    "link in a fold": (
        PAGE,
        "Slides S4",
        ":::{dropdown} Answer\n[x](gone.md)\n:::\nSlides S4",
        "leads nowhere",
    ),
    "doc role": (PAGE, "Slides S4", "{doc}`gone`, slides S4", "leads nowhere"),
    "notebook's link": (LESSON, "Predict.", "[x](../gone.md)", "leads nowhere"),
    "exercise's link": (EXERCISE, "Now check.", "[x](../gone.md)", "leads nowhere"),
    "link that copies lack": (LESSON, "Predict.", "[x](../README.md)", "is not there in work/"),
    "no front matter": (PAGE, "title: The", "# title: The", "lacks title"),
    "unreadable front matter": (PAGE, "title: The", "title: [The", "lacks title"),
    "another unit": (PAGE, f"unit: {SLUG}", "unit: 03_jacobian", "front matter says unit"),
    "no such slide": (PAGE, "[S4, S9]", "[S4, S9, S25]", "no slide S25"),
    "slide left out": (PAGE, "[S4, S9]", "[S4]", "must serve slide S9"),
    "slide not in the text": (PAGE, "Slides S4 and S9.", "Slide S4.", "text does not name slide S9"),
    "no such module": (
        PAGE,
        "[bodies, integrators]",
        "[bodies, integrators, joints]",
        "joints is not in reference/",
    ),
    "no minutes": (PAGE, "minutes: 90", "minutes: many", "whole number of minutes"),
    "no link to the module": (PAGE, "](../reference/bodies.py)", "]", "no link to its module"),
    "no link to the notebook": (PAGE, f"](../notebooks/{SLUG}.ipynb)", "]", "no link to notebooks"),
    "no link to the exercise": (PAGE, f"](../exercises/{SLUG}/{SLUG}.ipynb)", "]", "no link to exercises"),
    "lesson without its page": (LESSON, f"../{PAGE}", "../README.md", "does not link to"),
    "exercise without its page": (EXERCISE, f"../../{PAGE}", "../../README.md", "does not link to"),
    "lesson without slides": (LESSON, "Slides S4, S9", "Slide S10", "none of the unit's slides"),
    "module without its page": (BODIES, PAGE, "the page", "names no page"),
    "module with another page": (
        BODIES,
        "Slide S4;",
        "Slide S4; lectures/04_embedding.md",
        "which does not list it",
    ),
    "module without slides": (BODIES, "Slide S4;", "", "names none of the slides"),
    "module with another slide": (BODIES, "Slide S4;", "Slide S19, S4;", "no slide S19"),
    "module left out": (PAGE, "[bodies, integrators]", "[integrators]", "no page lists this module"),
    "unit left out": ("lectures/index.md", "16 particles", "particles", "16_particles has no row"),
    "unit not linked": ("lectures/index.md", f"]({SLUG}.md)", "]", "is written: link it"),
    "unwritten unit not marked": ("lectures/index.md", NEXT, "01 taxonomy", "is not written"),
    "unwritten unit linked": (
        "lectures/index.md",
        NEXT,
        "[01 x](01_taxonomy.md) (not yet written)",
        "is not written",
    ),
}


@pytest.mark.parametrize("fault", PLANTED)
def test_finds(root, fault):
    name, old, new, words = PLANTED[fault]
    edit(root, name, old, new)
    found = all_faults(root)
    assert any(words in line for line in found), found


@pytest.mark.parametrize(
    "name, words", [(LESSON, "notebooks/02"), (EXERCISE, "exercises/02"), ("lectures/index.md", "no row")]
)
def test_finds_what_is_missing(root, name, words):
    (root / name).unlink()
    assert any(words in line for line in all_faults(root))


def test_finds_a_notebook_without_a_page(root):
    sample.write_notebook(root / "notebooks/03_other.ipynb", sample.lesson())
    assert any("no unit's page belongs to it" in line for line in back_faults(root))


def test_units_out_of_order(root):
    words = (root / "lectures/index.md").read_text().splitlines(keepends=True)
    words[5], words[6] = words[6], words[5]
    (root / "lectures/index.md").write_text("".join(words))
    assert any("out of order" in line for line in index_faults(root))


def test_links_of_a_text():
    words = """[one](a.md "title") [two [deep]](b.md#x) ![three](c(1).png) [![four](d.png)](e.md) <https://f.org/x>
`[no](no1.md)` ``[no](`no2.md)`` $f[x](no3)$ {doc}`g` {doc}`title <h.md>`

$$
a[i](no4)
$$

~~~text
[no](no5.md)
~~~

````{note}
```python
[no](no6.md)
```
[five](i.md)
````
"""
    targets = "a.md b.md#x c(1).png e.md d.png https://f.org/x g.md h.md i.md"
    assert sorted(link.target for link in links(words)) == sorted(targets.split())
    assert {link.target: link.alt for link in links(words) if link.alt} == {
        "c(1).png": "three",
        "d.png": "four",
    }


def test_anchors_of_a_page(root):
    (root / "x.md").write_text(
        "# A `q̇` = E(q) ω!\n\n## Same\n\n## Same\n\n```\n# code\n```\n(label-1)=\n{#own}\n"
    )
    found = anchors(root, PurePosixPath("x.md"))
    assert {"same", "same-1", "label-1", "own"} <= found
    assert "code" not in found and "same-2" not in found


def test_a_page_that_lists_a_package_lists_its_modules(root):
    """A module in a listed package counts as listed, and names one of the pages that do so."""
    (root / "reference/lcp").mkdir()
    (root / "reference/lcp/__init__.py").write_text(f'"""LCP. S4; {PAGE}."""\n')
    (root / "reference/lcp/lemke.py").write_text(f'"""Lemke. S4; {PAGE}."""\n')
    assert any("which does not list it" in line for line in back_faults(root))
    edit(root, PAGE, "[bodies, integrators]", "[bodies, integrators, lcp]")
    assert back_faults(root) == []
    (root / "reference/lcp/lemke.py").write_text('"""Lemke. S4."""\n')
    assert back_faults(root) == ["reference/lcp/lemke.py: the docstring names no page"]
