"""Every notebook runs from top to bottom in JupyterLab as `course.py lab` serves it, in a real browser.

A copy of the course is served, so that nobody's work/ is touched, by the Python that runs the tests. The home
folder is a strange one: a kernel there is called python3 but is none.
"""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.parse
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support import expected_conditions as until
from selenium.webdriver.support.ui import WebDriverWait

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOKS = sorted(path.name for path in ROOT.glob("notebooks/[0-9]*.ipynb"))
PAGES = sorted(path.name for path in ROOT.glob("lectures/[0-9]*.md"))
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
DRIVER = shutil.which("chromedriver")
PATIENCE = 300  # seconds for one notebook, on a busy machine with nothing compiled yet

pytestmark = [
    pytest.mark.browser,
    pytest.mark.xdist_group("browser"),  # one server, one browser
    pytest.mark.skipif(not (CHROMIUM and DRIVER), reason="chromium or chromedriver is not installed"),
]


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A copy of the course, its compiled code in common, and one more notebook, for a kernel nobody has."""
    folder = tmp_path_factory.mktemp("browser") / "a course"
    ignored = shutil.ignore_patterns(".*", "work", "build", "tests", "__pycache__")
    shutil.copytree(ROOT, folder, ignore=ignored)
    kept = ROOT / "reference" / "__pycache__" / "compiled"
    kept.mkdir(parents=True, exist_ok=True)
    (folder / "reference" / "__pycache__").mkdir()
    (folder / "reference" / "__pycache__" / "compiled").symlink_to(kept)
    (folder / "notebooks").mkdir(exist_ok=True)
    cell = {
        "cell_type": "code",
        "id": "where",
        "metadata": {},
        "outputs": [],
        "execution_count": None,
        "source": "import sys, reference\nprint(sys.executable)\nprint(reference.__file__)",
    }
    foreign = {
        "nbformat": 4,
        "nbformat_minor": 5,
        "cells": [cell],
        "metadata": {"kernelspec": {"name": "elsewhere", "display_name": "Elsewhere"}},
    }
    (folder / "notebooks" / "99_foreign.ipynb").write_text(json.dumps(foreign), encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def address(course, tmp_path_factory):
    """Where `course.py lab` serves the copy."""
    home = tmp_path_factory.mktemp("home")
    kernel = home / ".local" / "share" / "jupyter" / "kernels" / "python3" / "kernel.json"
    kernel.parent.mkdir(parents=True)
    kernel.write_text(json.dumps({"argv": ["false"], "display_name": "Broken", "language": "python"}))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    log = home / "log"
    with log.open("w") as output:
        server = subprocess.Popen(
            [sys.executable, "course.py", "lab", "--no-browser", "--port", str(port)],
            cwd=course,
            stdout=output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            env=dict(os.environ, COURSE_PYTHON=sys.executable, HOME=str(home), USERPROFILE=str(home)),
        )
    try:
        yield wait_for_address(server, log)
    finally:
        server.terminate()
        server.wait(timeout=60)


def wait_for_address(server, log):
    deadline = time.monotonic() + 2 * PATIENCE  # the loops are compiled first
    while time.monotonic() < deadline and server.poll() is None:
        found = re.search(r"http://127\.0\.0\.1:\d+/\S+", log.read_text())
        if found:
            return found.group()
        time.sleep(0.2)
    pytest.fail(f"course.py lab serves nothing:\n{log.read_text()}")


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (
        "headless=new",
        "no-sandbox",
        "disable-gpu",
        "disable-dev-shm-usage",
        "no-first-run",
        "disable-background-networking",
        "disable-component-update",
        "disable-sync",
        "window-size=1400,1000",
        f"user-data-dir={tmp_path_factory.mktemp('chromium')}",
    ):
        options.add_argument("--" + flag)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(executable_path=DRIVER))
    yield driver
    driver.quit()


def open_in_lab(browser, address, path):
    """Opens a file in a workspace of its own: in a common one, Lab may bring earlier tabs back beside it."""
    parts, workspace = urllib.parse.urlsplit(address), Path(path).stem
    browser.get(f"{parts.scheme}://{parts.netloc}/lab/workspaces/{workspace}/tree/{path}?{parts.query}")


def run_all(browser, address, course, name):
    """Opens work/notebooks/`name`, runs all cells by the menu, and returns the cells as they were saved."""
    open_in_lab(browser, address, f"notebooks/{name}")
    wait = WebDriverWait(browser, 90)
    tab = f"//div[contains(@class,'lm-TabBar-tabLabel') and text()='{name}']"
    wait.until(until.presence_of_element_located((By.XPATH, tab)))
    wait.until(until.presence_of_element_located((By.XPATH, "//*[contains(text(), ') | Idle')]")))
    for place in (
        (By.XPATH, "//div[@class='lm-MenuBar-itemLabel' and text()='Run']"),
        (By.CSS_SELECTOR, "li[data-command='runmenu:run-all']"),
    ):
        wait.until(until.element_to_be_clickable(place)).click()
    copy, deadline = course / "work" / "notebooks" / name, time.monotonic() + PATIENCE
    while True:
        time.sleep(1)
        ActionChains(browser).key_down(Keys.CONTROL).send_keys("s").key_up(Keys.CONTROL).perform()
        cells = [
            cell
            for cell in saved_cells(copy)
            if cell["cell_type"] == "code" and "".join(cell["source"]).strip()
        ]
        if errors(cells) or all(cell["execution_count"] for cell in cells) or time.monotonic() > deadline:
            return cells


def saved_cells(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))["cells"]
    except ValueError:  # in the middle of being saved
        return saved_cells(file)


def errors(cells):
    return [
        "\n".join(output["traceback"])
        for cell in cells
        for output in cell["outputs"]
        if output["output_type"] == "error"
    ]


def test_a_strange_kernel_name_gets_the_courses_kernel(browser, address, course):
    (cell,) = run_all(browser, address, course, "99_foreign.ipynb")
    executable, package = "".join(cell["outputs"][0]["text"]).split("\n")[:2]
    assert Path(executable).samefile(sys.executable)
    assert Path(package) == course / "reference" / "__init__.py"


@pytest.mark.parametrize(
    "name", [NOTEBOOKS[0], *(pytest.param(name, marks=pytest.mark.slow) for name in NOTEBOOKS[1:])]
)  # test_notebooks.py runs them all, without a browser
def test_notebook_runs_in_the_browser(name, browser, address, course):
    cells = run_all(browser, address, course, name)
    assert not errors(cells), errors(cells)[0]
    late = [cell["id"] for cell in cells if not cell["execution_count"]]
    assert not late, f"cells not run after {PATIENCE} s: {late}"


@pytest.mark.parametrize("name", PAGES)
def test_page_opens_as_a_page_with_its_pictures(name, browser, address, course):
    open_in_lab(browser, address, f"lectures/{name}")
    text = (course / "lectures" / name).read_text(encoding="utf-8")
    pictures = len(re.findall(r"^!\[", text, re.MULTILINE))
    widths = "return [...document.querySelectorAll('.jp-MarkdownViewer img')].map(one => one.naturalWidth)"

    def all_there(_):
        found = browser.execute_script(widths)
        return len(found) == pictures and all(found)

    WebDriverWait(browser, 90).until(all_there, f"of {pictures} pictures, not all are shown")


def test_nothing_was_asked_of_the_network(browser, address):
    entries = (json.loads(entry["message"])["message"] for entry in browser.get_log("performance"))
    asked = {
        urllib.parse.urlsplit(entry["params"]["request"]["url"])
        for entry in entries
        if entry["method"] == "Network.requestWillBeSent"
    }
    hosts = {url.hostname for url in asked if url.scheme in ("http", "https", "ws", "wss")}
    assert hosts == {"127.0.0.1"}
