# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Options are understood or refused, and reach the run. The report, the summary as JSON, and what --strict does not
allow."""
import numpy as np
import pytest
from conftest import INPUT, RECONSTRUCTION, REFUSED, USAGE
from files import (OTHER_VALUES, crosses, json_of, las_bytes, make_sample, obj_text, pcd_bytes, pcd_text, ply_bytes,
                   sample_of, spiral)

NAN = float("nan")


def test_help_and_version(tool):
    for option in ("--help", "-h"):
        outcome = tool.succeed(option)
        assert outcome.err == ""
        for part in ("INPUT", "OUTPUT", "--topology NAME (auto)", "by-size", "--strict", "--neighbors N (20)",
                     "mean-value", "Examples:", "Exit codes:", "  6  with --strict"):
            assert part in outcome.out
    assert tool.succeed("--version").out.startswith("pcl_floater_reconstruct ")


def test_messages_name_the_option(cloud):
    for options, message in (
            ("--thread 4", "there is no option --thread; did you mean --threads?"),
            ("--neighbours 4", "there is no option --neighbours; did you mean --neighbors?"),
            ("--neigh 4", "there is no option --neigh; did you mean --neighbors or --neighborhood?"),
            ("--" + "x" * 10000, "there is no option --" + "x" * 10000),
            ("--facing outward", "--facing: 'outward' is none of: auto, outwards, up, viewpoint, normals, inwards; "
                                 "did you mean outwards?"),
            ("--facing AUTO", "--facing: 'AUTO' is none of: auto, outwards, up, viewpoint, normals, inwards; did you mean "
                              "auto?"),
            ("-k 20x", "--neighbors: '20x' is not a whole number"),
            ("-k 5", "--neighbors must be from 6 to 200"),
            ("-k", "--neighbors needs a value, N"),
            ("-k 20 --neighbors 30", "--neighbors is given 2 times; give it once"),
            ("--strict=maybe", "--strict takes no value, but has 'maybe'"),
            ("third.ply", "'third.ply' is one file too many: there are one INPUT and one OUTPUT"),
            ("--shift centre", "--shift: 'centre' is neither auto nor three numbers, such as 500000,5500000,0"),
            ("--max-memory lots", "--max-memory: 'lots' is not a size, such as 500M or 2G")):
        outcome = cloud.run("in.pcd out.ply " + options)
        assert (outcome.code, outcome.err) == (USAGE, f"pcl_floater_reconstruct: {message}\nTry --help.\n")
    # An option that is mistyped is told before what else is missing.
    cloud.fail("--hlep", USAGE, "there is no option --hlep; did you mean --help?")
    cloud.fail("in.pcd", USAGE, "OUTPUT is required; the simplest command is pcl_floater_reconstruct scan.pcd mesh.ply\n"
                                "Try --help.\n")
    cloud.fail("", USAGE, "INPUT is required")
    for names in (["in.pcd", ""], ["", "out.ply"]):
        cloud.fail(names, USAGE, "INPUT and OUTPUT are names of files; one of them is empty")


def test_bad_options_are_refused(cloud):
    for options, cause in (
            ("-k 99999999999999999999", "is not a whole number"),
            ("--opening-angle wide", "'wide' is not a number"),
            ("--holes by-size", "--holes by size need"),
            ("--largest-hole-length 1 --largest-hole 2", "excludes"),
            ("--shift 1,2", "'1,2' is neither auto nor three numbers"),
            ("--shift 1,2,nan", "'1,2,nan' is neither"),
            ("--viewpoint 1,2", "'1,2' is neither auto, none, nor three numbers"),
            ("--facing viewpoint --viewpoint none", "no viewpoint is looked for"),
            ("--facing normals", "--facing normals: the points of 'in.pcd' have no normals"),
            ("--use-input-normals on", "--use-input-normals on: the points of 'in.pcd' have no normals"),
            ("--topology surface --parameterization flat.ply", "are for a disc"),
            ("--method tw385 --topology surface", "TW 385"),
            ("--max-memory 1M", "'1M' is too small; it must be "),
            ("--scratch .", "--scratch is of no use without --max-memory"),
            ("--max-memory 2G --topology disc", "of a disc"),
            ("--max-memory 2G --parameterization flat.ply", "of a disc"),
            ("--max-memory 2G --uv", "--max-memory"),
            ("--max-memory 2G --html page.html", "--max-memory"),
            ("--texture c.jpg", "no PNG file"),
            ("--texture-size 512", "without --texture"),
            ("--texture c.png --texture-size 7", "--texture-size"),
            ("--texture c.png", "have no colours"),
            *((f"{option} -", f"{option} takes the name of a file, not -")
              for option in ("--report", "--html", "--loop", "--parameterization"))):
        cloud.fail("in.pcd out.ply " + options, USAGE, cause)


def test_same_file_twice(cloud):
    cloud.succeed("in.pcd cloud.ply -q")
    before = cloud.read("cloud.ply")
    cloud.path("link.ply").symlink_to("cloud.ply")
    for arguments, names in (("cloud.ply cloud.ply", "INPUT and OUTPUT "), ("cloud.ply ./cloud.ply", "INPUT and OUTPUT "),
                             ("cloud.ply link.ply", "INPUT and OUTPUT "),
                             ("in.pcd a.ply --report ./a.ply", "OUTPUT and --report "),
                             ("in.pcd a.ply --html ./a.ply", "OUTPUT and --html "),
                             ("in.pcd a.ply --report a --html a", ""),
                             ("in.pcd a.ply --parameterization a.ply", ""),
                             ("in.pcd a.ply --report in.pcd", "INPUT and --report "),
                             ("--uv --report a.mtl in.pcd a.obj", "")):
        cloud.fail(arguments, USAGE, names + "are the same file")
    assert cloud.read("cloud.ply") == before


def test_options_reach_the_run_and_the_report(cloud):
    defaults = cloud.report()["options"]
    for name, value in [*OTHER_VALUES.items(), ("viewpoint", "none"), ("facing", "outwards")]:
        if name == "method":
            continue  # it sets others, see below
        assert defaults[name] != value
        text = ("off", "on")[value] if isinstance(value, bool) else str(value).strip("[]").replace(" ", "")
        # The report is written even if the option makes the run fail on this cloud.
        cloud.path("out.json").unlink()
        cloud.run(f"in.pcd out.ply --report out.json --{name.replace('_', '-')} {text}")
        assert json_of(cloud.text("out.json"))["options"] == {**defaults, name: value}
    assert cloud.report("--flips off")["statistics"]["flips"] == 0


def test_loop_from_file(cloud):
    loop = cloud.report()["loop"]
    cloud.write("loop.txt", "# the loop\n" + "".join(f"{p}{', ' if p % 2 else chr(10)}" for p in loop))
    again = cloud.report("--loop loop.txt")
    assert again["loop"] == loop and again["options"]["loop_given"]
    assert again["topology"] == cloud.report("--parameterization flat.ply")["topology"] == "disc"
    arguments = "in.pcd other.ply --loop bad.txt"
    cloud.fail(arguments, INPUT, "cannot read 'bad.txt': there is no such file")
    for text, code, cause in (("1 2\n3 -4\n", INPUT, "line 2: '-4' is not the index of a point"),
                              ("# nothing\n", INPUT, "no indices"), ("1 2 3 1000000\n", RECONSTRUCTION, "(INVALID_LOOP)")):
        cloud.write("bad.txt", text)
        cloud.fail(arguments, code, cause)


def test_the_method_of_the_report_and_options_without_effect(cloud):
    made = cloud.report("--method tw385 --cluster-tolerance 0.2")
    options = made["options"]
    assert [options[key] for key in ("method", "topology", "boundary")] == ["tw385", "disc", "two-segments"]
    assert "no effect" not in str(made["warnings"])
    # What is given stays.
    other = cloud.report("--method tw385 --boundary consensus --scatter drop --flips on")
    assert other["options"]["boundary"] == "consensus"
    assert "options have no effect: --scatter, --flips; --method tw385" in str(other["warnings"])
    assert "warning: an option has no effect: solver" in cloud.succeed(
        "in.pcd out.ply --topology surface --solver bicgstab-ilut").err


def share_up(mesh):
    """Share of the triangles that face up."""
    return (crosses(mesh)[:, 2] > 0).mean()


def test_normals_of_the_input_reach_the_run(cloud):
    """The wavy square of the sample, with normals that point down."""
    cloud.sample.normals[:] = (0.1, 0, -1)
    cloud.write("down.pcd", pcd_bytes(cloud.sample))
    cloud.report("", "down.pcd")
    assert share_up(cloud.mesh()) == 1
    assert cloud.report("--facing normals", "down.pcd")["facing_parts"] == {"normals": 1}
    assert share_up(cloud.mesh()) == 0
    assert cloud.report("--use-input-normals on", "down.pcd")["options"]["use_input_normals"]
    assert share_up(cloud.mesh()) == 0


def test_viewpoints_reach_the_run_and_are_shifted(cloud):
    """The viewpoint of a PCD file is that of the sensor, unless it is (0, 0, 0), which nobody told. Shifts move the
    sensor and the viewpoint, too: without that, they would change sides."""
    cloud.write("below.pcd", cloud.text("in.pcd").replace("VIEWPOINT 0 0 0", "VIEWPOINT 5 5 -40"))
    for shift in ("0,0,0", "0,0,100"):
        report = cloud.report(f"--facing viewpoint --viewpoint none --shift {shift}", "below.pcd")
        assert report["facing_parts"] == {"sensor": 1} and share_up(cloud.mesh()) == 0
        cloud.report(f"--facing viewpoint --viewpoint 5,5,-40 --shift {shift}")
        assert share_up(cloud.mesh()) == 0
    cloud.report("--facing viewpoint --shift 5,5,40")  # not a sensor below the ground
    assert share_up(cloud.mesh()) == 1


def test_degrees_are_told(cloud):
    """Longitude and latitude with heights in metres, by names, by the scales of LAS, or by extents."""
    column, row = np.tile(np.arange(30), 30), np.repeat(np.arange(30), 30)
    points = np.stack([-70.1 + column * 1e-4, -33.2 + row * 1e-4, 5 * np.sin(0.3 * column)], -1)

    def told(name, content):
        return cloud.run(cloud.write(name, content), "out.ply").err

    def text(header, scale=1):
        return header + "".join("{:.10g},{:.10g},{:.6g}\n".format(scale * x, scale * y, z) for x, y, z in points)
    south = "+proj=utm +zone=19 +south (of"
    assert south in told("a.csv", text("longitude,latitude,depth\n")) and south in told("b.csv", text(""))
    las = las_bytes(np.round(points * (1e7, 1e7, 100)).astype(int), scale=(1e-7, 1e-7, 0.01))
    assert "out_srs=EPSG:32719" in told("c.las", las)
    cloud.write("d.csv", text("longitude_m,latitude_m,z\n"))
    assert not cloud.read_cloud("d.csv")["may_be_degrees"]
    assert "degrees" not in told("e.csv", text("", 111e3))


def test_pixels_without_return_are_left_out(cloud):
    """They are no vertices, and neither are those with a NaN."""
    size = len(cloud.sample.points)
    cloud.write("zeros.pcd", pcd_text([*np.zeros((20, 3)), *(cloud.sample.points + (0, 0, 30)), (NAN, 0, 0)]))
    report = cloud.report("", "zeros.pcd")
    assert (report["findings"][0]["id"], len(report["non_finite"])) == ("invalid_pixels", 21)
    assert report["output"]["vertices"] == size == len(cloud.mesh().points)
    warnings = str(report["warnings"])
    assert "20 points are at (0, 0, 0)" in warnings and "1 point without finite coordinates" in warnings
    assert cloud.report("--remove-outliers off", "zeros.pcd")["output"]["vertices"] == size + 20


@pytest.fixture
def on_map(cloud):
    """Clouds whose coordinates are far from zero: points 0.3 m apart at map coordinates."""
    sample = sample_of((500123.4, 5500456.7, 312) + 0.3 * cloud.sample.points, is_double=True)
    cloud.write("double.pcd", pcd_bytes(sample))
    cloud.write("double.ply", ply_bytes(sample))
    cloud.write("double.obj", obj_text(sample))
    # Text whose header says float, with more digits than that.
    cloud.write("text.pcd", pcd_text(sample.points))
    cloud.write("text.ply", ply_bytes(sample, "ascii").replace(b"property double", b"property float"))
    sample.is_double = False
    cloud.write("float.pcd", pcd_bytes(sample))
    cloud.points = sample.points
    return cloud


def test_auto_moves_the_origin_to_the_cloud(on_map):
    on_map.succeed("double.pcd plain.ply -q --precision double")
    plain = on_map.mesh("plain.ply")
    for name in ("double.pcd", "double.ply", "double.obj", "text.pcd", "text.ply"):
        report = on_map.report("--shift auto", name)
        shift, mesh = np.array(report["shift"]), on_map.mesh()
        assert np.linalg.norm(shift - on_map.points[0]) < 10 and (shift == np.round(shift)).all(), name
        assert report["statistics"]["coordinate_step"] == 0 and not mesh.is_double
        assert np.abs(mesh.points + shift - on_map.points).max() < 1e-5
        assert np.array_equal(mesh.triangles, plain.triangles)
        assert b"\ncomment shift 5001" in on_map.read("out.ply")
    # Gross outliers do not count.
    on_map.write("far.pcd", pcd_text([*on_map.points, (0, 0, 0), (1e10, 0, 0)]))
    assert abs(on_map.report("--shift auto", "far.pcd")["shift"][0] - 500123.4) < 10
    # Near zero there is no need.
    assert on_map.report("--shift auto")["shift"] == [0, 0, 0] and b"comment shift" not in on_map.read("out.ply")


def test_a_given_origin(on_map):
    # Without one, it is chosen where 32 bits are too coarse.
    assert "too coarse for them" in on_map.succeed("double.ply out.ply").out
    assert on_map.report("--shift auto", "double.ply")["shift"] == on_map.report("", "double.ply")["shift"]
    for name in ("out.ply", "out.vtk", "out.obj", "out.off", "out.stl"):
        outcome = on_map.succeed(f"double.ply {name} --shift 500000,5500000,-12.5")
        assert "shift      500000 5500000 -12.5, subtracted" in outcome.out
        assert (b"shift 500000 5500000 -12.5" in on_map.read(name)) == (name != "out.stl")
        if name != "out.stl":
            assert np.abs(on_map.mesh(name).points + (500000, 5500000, -12.5) - on_map.points).max() < 1e-4
    # A first number below zero is no option.
    on_map.succeed("in.pcd out.ply -q --shift -5,0,0")
    assert abs(on_map.mesh().points[0, 0] - on_map.sample.points[0, 0] - 5) < 1e-5


def test_coarse_coordinates_are_told(on_map):
    for name in ("float.pcd", "text.pcd"):
        report = on_map.report("-q", name)
        assert report["statistics"]["coordinate_step"] > 0.1
        warnings = str(report["warnings"])
        assert "the coordinates are coarse: along y they are 0.5 apart, " in warnings and "subtract an origin" in warnings
    on_map.succeed("double.pcd out.ply --precision double --strict")
    on_map.succeed("text.pcd out.ply --strict --shift auto")


def test_json_is_the_last_line(cloud):
    for option in ("-q", "--threads=1"):
        lines = cloud.succeed(f"in.pcd out.ply --json {option}").out.splitlines()
        assert (len(lines) == 1) == (option == "-q")
        summary = json_of(lines[-1])
        for key, value in {"status": "SUCCESS", "points": 144, "components": 1, "genus": 0, "loops": 1, "outliers": 0,
                           "denoised": False, "triangles": len(cloud.mesh().triangles)}.items():
            assert summary[key] == value, key
        assert summary["topology"] != "unknown" and isinstance(summary["topology_reason"], str)
        assert summary["recon_seconds"] > 0


def test_the_report_names_points_of_the_input(cloud):
    """A repeated point, and two without finite coordinates: the first one and one in between."""
    kept = cloud.sample.points.tolist()
    points = [(NAN, 0, 0), *kept[:9], (0, float("inf"), 0), *kept[9:]]
    points.append(points[5])
    cloud.write("in.pcd", pcd_text(points))
    report = cloud.report()
    assert (report["tool"], report["status"], report["message"]) == ("pcl_floater_reconstruct", "SUCCESS", "")
    assert (report["input"]["file"], report["input"]["points"]) == ("in.pcd", len(points))
    assert (report["output"]["vertices"], report["statistics"]["used_points"]) == (len(points) - 2, 144)
    assert (report["non_finite"], report["duplicates"], report["unused"]) == ([0, 10], [[len(points) - 1, 5]], [])
    assert "2 points without finite coordinates were left out" in str(report["warnings"])
    # The vertices after a point that was left out move up, and so do the indices of triangles.
    mesh = cloud.mesh()
    assert mesh.points.tolist() == [*kept, kept[4]] and mesh.triangles.max() < 144
    corners = mesh.points[mesh.triangles]
    assert np.linalg.norm(corners - corners[:, :1], axis=2).max() < 4


def test_the_report_has_findings_as_data(cloud):
    cloud.write("far.pcd", pcd_text([*cloud.sample.points, (0, 0, 1e6)]))
    finding, = cloud.report("", "far.pcd")["findings"]
    assert [finding[key] for key in ("id", "severity", "numbers")] == ["gross_outliers", "note", [1, 144]]
    # Points on others are in the mesh.
    cloud.write("in.pcd", pcd_text([*cloud.sample.points, *(cloud.sample.points + (0, 0, 0.01))]))
    report = cloud.report()
    statistics, finding = report["statistics"], report["findings"][0]
    assert (statistics["used_points"], statistics["stacked_points"]) == (288, 144)
    assert statistics["largest_stack_height"] < 0.03
    assert (finding["id"], finding["severity"]) == ("stacked_points", "note")
    assert "\nstacks     " in cloud.succeed("in.pcd out.ply").out
    assert cloud.report("--topology disc")["statistics"]["stacked_points"] == 0


def test_the_report_tells_what_the_mesh_is(cloud):
    report = cloud.report("--topology disc")
    statistics, check, loop = report["statistics"], report["check"], report["loop"]
    for part, values in (
            (report, {"topology": "disc", "topology_reason": "asked for", "outliers": [], "loop_decisions": [],
                      "facing_decisions": []}),
            (statistics, {"working_points": 144, "loop_points": len(loop), "triangles": report["output"]["triangles"],
                          **dict.fromkeys(("outlier_points", "holes_filled", "remade_points", "self_intersections_found",
                                           "self_intersection_flips", "self_intersection_moves",
                                           "self_intersection_rebuilds"), 0)}),
            (check, {"components": 1, "euler_characteristic": 1, "self_intersections_at": [],
                     **dict.fromkeys(("nonmanifold_edges", "nonmanifold_vertices", "genus",
                                      "folds", "degenerate_triangles", "self_intersections"), 0)})):
        assert {key: part[key] for key in values} == values
    assert report["peak_memory_bytes"] > 10**6 and statistics["noise"] < 0.1
    assert report["facing_certainty"] > 0.95
    for stage in ("working set", "neighbors", "stars", "boundary", "weights", "solve", "delaunay", "flips", "consensus",
                  "holes", "check"):
        assert report["seconds"][stage] >= 0
    assert check["longest_edge"] > 1 and len(check["longest_edge_at"]) == 2
    summary, = check["loops"]
    assert len(loop) >= 30 and (summary["points"], summary["at"]) == (len(loop), min(loop))
    # Of a square of side 11.
    assert summary["width"] > 10 and summary["length"] > 2 * summary["width"] and summary["width_spacings"] > 5


def test_strict_refuses_lost_points_and_poor_meshes(cloud):
    cloud.write("out.ply", "what was there before")
    island = [(200 + i, j, 0) for i in range(6) for j in range(6)]
    cloud.write("island.pcd", pcd_text([*make_sample(side=24).points, *island]))
    cause = "36 points are in no triangle, point 576 (200, 0, 0) among them"
    for quiet in ("--quiet", "--threads=0"):
        outcome = cloud.run(f"island.pcd out.ply --report out.json --topology disc {quiet} --strict")
        assert (outcome.code, outcome.out) == (REFUSED, "")
        assert outcome.err.startswith("warning: " + cause)
        assert outcome.err.endswith("pcl_floater_reconstruct: cannot reconstruct 'island.pcd': 36 points are in no "
                                    "triangle, which --strict does not allow (REFUSED)\n")
        report = json_of(cloud.text("out.json"))
        assert (report["status"], report["strict"], report["output"]) == ("REFUSED", True, None)
        assert len(report["warnings"]) == 1 and report["warnings"][0].startswith(cause)
        assert report["check"]["components"] == 1
        cloud.path("out.json").unlink()
        assert cloud.names() == {"in.pcd", "line.pcd", "island.pcd", "out.ply"}
        assert cloud.text("out.ply") == "what was there before"
    summary = json_of(cloud.run("island.pcd out.ply --topology disc --strict --json").out)
    assert (summary["status"], summary["output"]) == ("REFUSED", None)
    cloud.succeed("island.pcd lax.ply --topology disc -q")
    # A good mesh is written; a run that fails anyway fails as without --strict.
    cloud.succeed("in.pcd good.ply --strict -q")
    assert np.array_equal(cloud.mesh("good.ply").points, cloud.sample.points)
    cloud.fail("line.pcd out.ply --strict", RECONSTRUCTION, "(DEGENERATE)")


def test_the_report_tells_which_side_may_not_be_the_front(cloud):
    """A shallow bowl is half a body or a valley."""
    cloud.write("bowl.pcd", pcd_text(spiral(2000, 0.6) * (1, 1, -1)))  # three tenths of a sphere
    told = "not sure   which side is the front of 1 part\n"
    assert told in cloud.succeed("bowl.pcd out.ply --verbose").out
    report = cloud.report("", "bowl.pcd")
    decision, = report["facing_decisions"]
    assert (decision["rule"], decision["certainty"]) == ("body", report["facing_certainty"])
    assert decision["triangles"] == report["statistics"]["triangles"] and report["facing_certainty"] < 0.9
