# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The quick start, and the page of --html: what is in it, and what a browser shows of it."""
import base64
import html.parser
import json
import os
import pathlib
import re
import shutil

import numpy as np
import pytest
from conftest import BUILD, GENERATE, OK, RECONSTRUCTION, REFUSED, TOOL
from files import json_of

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
QUICKSTART = pathlib.Path(__file__).resolve().parents[2] / "tools/quickstart.sh"


def results(tool):
    folder = tool.path("floater_result")
    return set(os.listdir(folder)) if folder.is_dir() else set()


def number_of_points(tool):
    return int(re.search(rb"^POINTS (\d+) ", tool.read("floater_result/mesh.vtk"), re.MULTILINE)[1])


def test_clouds_of_the_quick_start_take_the_place_of_each_other(tool):
    said = tool.check(OK, QUICKSTART, "--build", BUILD, says="tum_rabbit.pcd")
    made = {"mesh.vtk", "report.json", "picture.png"}
    assert results(tool) == made and number_of_points(tool) == 10429
    for name in made:
        assert name in said and len(tool.read(f"floater_result/{name}")) > 1000
    report = json_of(tool.text("floater_result/report.json"))
    check = report["check"]
    assert (check["components"], len(check["loops"]), check["genus"], report["warnings"]) == (1, 1, 0, [])

    tool.write("sheet.obj", "".join(f"v {i % 30} {i // 30} {0.3 * ((i * i + i // 30) % 7) / 7}\n" for i in range(900)))
    tool.check(OK, QUICKSTART, "sheet.obj", "--build", BUILD, says="sheet.obj")
    assert results(tool) == made and number_of_points(tool) == 900
    assert "sheet.obj" in str(json_of(tool.text("floater_result/report.json"))["input"])

    tool.write("broken.pcd", "no cloud\n")
    tool.check(2, QUICKSTART, "--build", BUILD, "broken.pcd", says="broken.pcd")
    assert not results(tool)  # nothing of an earlier cloud


def test_wrong_command_lines_of_the_quick_start_are_refused(tool):
    tool.check(OK, QUICKSTART, "--help", says="Usage")
    for arguments, says in ((["--unknown"], "Usage"), (["a.pcd", "b.pcd"], "Usage"), (["--build"], "needs a folder"),
                            (["", "--build", "none"], "name of the cloud is empty"), (["."], "cannot read"),
                            (["none.pcd"], "none.pcd")):
        tool.check(1, QUICKSTART, *arguments, says=says)
    assert not results(tool)


def page(tool, cloud, *options, code=OK, says=""):
    """Writes page.html and report.json. Returns the data of the page, and the report."""
    tool.check(code, TOOL, cloud, "mesh.ply", "-q", "--html", "page.html", "--report", "report.json", *options, says=says)
    text = tool.text("page.html")
    elements, data = [], []

    class Reader(html.parser.HTMLParser):
        def handle_starttag(self, tag, attributes):
            elements.append((tag, dict(attributes)))

        def handle_data(self, text):
            if elements and elements[-1] == ("script", {"type": "application/json", "id": "data"}):
                data.append(text)

    Reader().feed(text)
    # Nothing from outside: no address but the name of a standard, no element or style that loads one.
    assert set(re.findall(r"https?://[^\s\"'<)]*", text)) <= {"http://www.w3.org/2000/svg"}
    assert not {tag for tag, _ in elements} & {"link", "img", "iframe", "object", "embed", "base", "form"}
    assert not [a for _, a in elements if {"src", "href"} & set(a)]
    assert "url(" not in text and "@import" not in text and "default-src 'none'" in text
    assert sum(tag == "script" for tag, _ in elements) == 2
    return json.loads("".join(data)), json.loads(tool.text("report.json"))


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text, validate=True), kind)


@pytest.fixture
def noisy(tool):
    """A cloud with flaws, and with a point far away."""
    tool.check(OK, GENERATE, "torus torus.ply --points 3000 --noise 0.9")
    content = tool.read("torus.ply").replace(b"element vertex 3000", b"element vertex 3002")
    tool.write("noisy.ply", content + np.array([1e9, 0, 0, 300, 300, 300], "<f4").tobytes())
    return tool


LISTS = ("loop", "unused", "outliers", "scatter", "non_finite", "duplicates")


def test_counts_of_the_page_are_those_of_the_report(noisy):
    data, report = page(noisy, "noisy.ply")
    for key in set(report) - {"seconds", "peak_memory_bytes"}:
        assert data["report"][key] == (len(report[key]) if key in LISTS else report[key])
    assert data["sentences"] and set(data["sentences"]) <= set(report["warnings"])
    mesh, used = data["mesh"], report["statistics"]["used_points"]
    assert mesh["triangles"] == mesh["shown"] == report["statistics"]["triangles"]
    corners = numbers(mesh["corners"], "<u4")
    assert len(corners) == 3 * mesh["shown"] and np.array_equal(np.unique(corners), np.arange(used))
    assert len(numbers(mesh["positions"], "<f4")) == 3 * used
    for name, histogram in data["histograms"].items():
        assert sum(histogram["counts"]) == used, name
    for flaw in mesh["flaws"]:
        triangles = numbers(flaw["triangles"], "<u4")
        assert len(set(triangles)) == flaw["count"] and max(triangles, default=0) < mesh["shown"]
        expected = {"crossing": "self_intersections", "folded": "folds", "flat": "degenerate_triangles"}
        if flaw["name"] in expected:
            assert (flaw["count"] > 0) == (report["check"][expected[flaw["name"]]] > 0), flaw["name"]
    dots = {kind["name"]: kind for kind in mesh["dots"]}
    assert {name: kind["count"] for name, kind in dots.items()} == {
        "points": 0, **{name: len(report[name]) for name in ("scatter", "outliers", "unused")}}
    assert dots["outliers"]["shown"] < dots["outliers"]["count"]  # one is too far away to be shown


def test_a_large_mesh_is_thinned_but_for_its_flaws(noisy):
    (whole, _), (some, report) = page(noisy, "noisy.ply"), page(noisy, "noisy.ply", "--page-triangles", "2000")
    mesh = some["mesh"]
    assert mesh["triangles"] == report["statistics"]["triangles"] and 1000 < mesh["shown"] <= 2000
    assert [flaw["count"] for flaw in mesh["flaws"]] == [flaw["count"] for flaw in whole["mesh"]["flaws"]]
    assert some["histograms"] == whole["histograms"]
    triangles = numbers(mesh["corners"], "<u4").reshape(-1, 3)
    assert (len(triangles), triangles.max()) == (mesh["shown"], len(numbers(mesh["positions"], "<f4")) / 3 - 1)
    assert all(len(set(triangle)) == 3 for triangle in triangles)
    few = page(noisy, "noisy.ply", "--page-triangles", "20")[0]["mesh"]  # less than there are flaws
    assert (mesh["all_flaws"], few["all_flaws"]) == (True, False) and 0 < few["shown"] <= 20


def test_no_name_or_text_becomes_html(noisy):
    name = "</script><img src=x onerror=alert(1)>&amp;\"'\u2028.ply"
    noisy.path("<").mkdir()
    noisy.path("noisy.ply").rename(noisy.path(name))
    data, report = page(noisy, name)
    assert data["report"]["input"]["file"] == report["input"]["file"] == name


def test_a_failure_has_a_page_with_the_points(tool):
    tool.write("line.xyz", "".join(f"{i} 0 0\n" for i in range(50)))
    data, report = page(tool, "line.xyz", code=RECONSTRUCTION, says="line.xyz")
    assert data["report"]["message"] == report["message"]
    assert (data["mesh"]["shown"], data["mesh"]["dots"][0]["shown"]) == (0, 50)
    tool.check(OK, GENERATE, "torus torus.ply --points 3000 --noise 1.5")
    data, report = page(tool, "torus.ply", "--scatter", "keep", "--strict", code=REFUSED, says="--strict")
    assert report["status"] == data["report"]["status"] == "REFUSED" and data["mesh"]["shown"] > 0


@pytest.mark.skipif(BROWSER is None, reason="Chromium is missing")
def test_a_browser_shows_the_mesh_and_goes_to_a_flaw(noisy):
    pytest.importorskip("matplotlib")

    def show(anchor=""):
        """The pixels of the page in a browser."""
        noisy.check(OK, BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader",
                    "--enable-unsafe-swiftshader", "--hide-scrollbars",
                    "--force-prefers-reduced-motion",  # a busy machine may draw the page before a flight ends
                    f"--user-data-dir={noisy.path('profile')}", "--window-size=1000,700", "--virtual-time-budget=4000",
                    f"--screenshot={noisy.path('page.png')}", f"file://{noisy.path('page.html')}{anchor}")
        return noisy.pixels("page.png").reshape(-1, 3)
    page(noisy, "noisy.ply")
    whole, near = show(), show("#place=1")
    rings = [(pixels == (11, 108, 255)).all(1).sum() for pixels in (whole, near)]
    assert rings[0] == 0 and rings[1] > 100
    assert ((whole[:, 2] > whole[:, 0] + 20) & (whole[:, 0] > 70)).sum() > 20000  # of the front
    assert (near[:, 0] > near[:, 2] + 100).sum() > 500  # of the flaw
