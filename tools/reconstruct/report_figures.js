// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const report = data.report, mesh = data.mesh, statistics = report.statistics, check = report.check || {};
const $ = id => document.getElementById(id);
const FLAWS = { crossing: ["#d81e2c", "crossing triangles"], folded: ["#ff8c1a", "folded edges"],
  flat: ["#c013b0", "triangles without area"], long: ["#e8c400", "longest edges inside"] };
const DOTS = { points: ["#6f8fb0", "points of the cloud"], scatter: ["#2f9e44", "scatter"],
  outliers: ["#7048e8", "outliers"], unused: ["#0aa2c0", "unused points"] };
const FLAW_OF_FINDING = { crossing_triangles: "crossing", folds: "folded", no_area: "flat", long_edges: "long" };
const count = n => Number(n).toLocaleString("en");
const number = x => x == null ? "-" : Math.abs(x) >= 1e12 || Math.abs(x) < 1000 && !Number.isInteger(x) ?
  String(+x.toPrecision(3)) : count(Math.round(x));
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
const XYZ = [0, 1, 2];
const place = at => "(" + at.map(x => +x.toPrecision(7)).join(", ") + ")";
const sentence = text => text.charAt(0).toUpperCase() + text.slice(1) + ".";
const plural = (n, word) => count(n) + " " + word + (n === 1 ? "" : "s");

/// An element with text and children; texts are never taken for HTML.
function element(kind, attributes, ...children) {
  const is_svg = /^(svg|rect|line|text|title|g)$/.test(kind);
  const made = is_svg ? document.createElementNS("http://www.w3.org/2000/svg", kind) : document.createElement(kind);
  for (const [key, value] of Object.entries(attributes || {}))
    key.startsWith("on") ? made.addEventListener(key.slice(2), value) : made.setAttribute(key, value);
  made.append(...children.filter(child => child != null));
  return made;
}
const soft = (...children) => element("span", { class: "soft" }, ...children);
const dot = colour => element("span", { class: "dot", style: "background:" + colour });

// Numbers and positions, from base64.
function decode(text, Type) {
  const characters = atob(text), bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return new Type(bytes.buffer);
}
// Positions are drawn with the box of the mesh around the origin, and half its diagonal as the unit.
let centre = [0, 0, 0], unit = 1, positions = new Float32Array(0), corners = new Uint32Array(0);
function place_of(x, y, z) { return [x, y, z].map((v, i) => centre[i] + unit * v); } // in the cloud
function drawn(at) { return at.map((v, i) => (v - centre[i]) / unit); }
function decode_positions(text) {
  return decode(text, Float32Array).map((v, i) => (mesh.origin[i % 3] - centre[i % 3] + mesh.unit * v) / unit);
}
function box_of(values) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < values.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], values[i]);
    high[i % 3] = Math.max(high[i % 3], values[i]);
  }
  return [low, high];
}
const dots = [], flaws = [];
let spacing = 0.01, normals = new Float32Array(0), mean_normal = [0, 0, 0], extent = [1, 1, 1];
if (mesh) {
  centre = mesh.origin.slice();
  unit = mesh.unit; // of the first look
  const first = decode_positions(mesh.shown ? mesh.positions : mesh.dots[0].positions);
  const [low, high] = box_of(first), half = Math.hypot(...high.map((v, i) => v - low[i])) / 2 || 1;
  extent = high.map((v, i) => (v - low[i]) / half);
  centre = place_of(...high.map((v, i) => (v + low[i]) / 2));
  unit *= half;
  positions = decode_positions(mesh.positions);
  corners = decode(mesh.corners, Uint32Array);
  spacing = mesh.spacing / unit || 0.01;
  normals = new Float32Array(positions.length);
  let area = 0;
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    const u = XYZ.map(i => positions[b + i] - positions[a + i]), v = XYZ.map(i => positions[c + i] - positions[a + i]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    area += Math.hypot(...n);
    for (let i = 0; i < 3; ++i) {
      mean_normal[i] += n[i];
      normals[a + i] += n[i], normals[b + i] += n[i], normals[c + i] += n[i];
    }
  }
  mean_normal = mean_normal.map(x => x / (area || 1));
  const shown = (kind, [colour, label], more) => ({ ...kind, colour, label, on: true, ...more });
  for (const kind of mesh.dots)
    if (kind.count) dots.push(shown(kind, DOTS[kind.name], { at: decode_positions(kind.positions) }));
  for (const kind of mesh.flaws)
    if (kind.count) flaws.push(shown(kind, FLAWS[kind.name], { numbers: decode(kind.triangles, Uint32Array) }));
}
// Flaws that are near each other are one place.
for (const flaw of flaws) {
  const cells = new Map();
  for (const t of flaw.numbers) {
    const at = XYZ.map(i => XYZ.reduce((sum, c) => sum + positions[3 * corners[3 * t + c] + i] / 3, 0));
    const key = at.map(x => Math.floor(x / (16 * spacing))).join();
    cells.has(key) ? cells.get(key).push(at) : cells.set(key, [at]);
  }
  flaw.places = [...cells.values()].sort((a, b) => b.length - a.length).map(all => {
    const mean = XYZ.map(i => all.reduce((sum, at) => sum + at[i], 0) / all.length);
    const off = at => Math.hypot(...at.map((v, i) => v - mean[i]));
    return { count: all.length, at: all.reduce((best, at) => off(at) < off(best) ? at : best) };
  });
}

// Outcome and figures.
const base = path => path ? path.replace(/^.*[/\\]/, "") : "";
$("name").textContent = base(report.input.file) + (report.output ? " → " + base(report.output.file) : "");
document.title = "Report: " + base(report.input.file);
const verdict = report.verdict, has_failed = report.status !== "SUCCESS";
$("badge").textContent = has_failed ? "no mesh" : verdict.value;
$("badge").className = "badge " +
  (has_failed ? "failed" : { good: "good", usable: "doubts" }[verdict.value] || "flaws");
$("headline").textContent = sentence(has_failed ? report.message : !verdict.cause ? "Hardly a flaw in the mesh" :
  verdict.cause + ". What helps: " + verdict.remedy);
function figure(value, label) {
  $("figures").append(element("div", { class: "card" }, element("b", null, value), soft(label)));
}
figure(count(statistics.used_points), "of " + plural(report.input.points, "point") + " in the mesh");
figure(count(statistics.triangles), "triangles");
if (report.check) {
  figure(count(check.components), (check.components === 1 ? "component" : "components") + ", genus " + check.genus);
  const loops = check.loops.length, crossing = check.self_intersections;
  figure(count(loops), loops === 1 ? "boundary loop" : loops ? "boundary loops" : "boundary loops: closed");
  figure(number(crossing), crossing == null ? "crossings: not searched in a scan" : "crossing pairs");
  figure(count(check.folds), "folded edges");
}
if (data.histograms.spacing) figure(number(data.histograms.spacing.median), "spacing, median");
figure(number(report.seconds.reconstruction), "seconds to reconstruct");

// The list: what was found, and what is not sure.
let select = () => {}; // set by the viewer
const chips = [];
function chip(text, at, width) {
  const index = chips.length + 1; // a link to the page can name it: report.html#place=3
  chips.push(element("button", { title: place(at), onclick: event => {
    for (const other of chips) other.classList.remove("on");
    event.currentTarget.classList.add("on");
    select(drawn(at), (width || 0) / unit);
    history.replaceState(null, "", "#place=" + index);
  } }, text));
  return chips[index - 1];
}
const groups = { flaw: ["Flaws", []], doubt: ["Doubts", []], note: ["Notes", []], loop: ["Boundary loops", []] };
function entry(group, colour, text, places) {
  groups[group][1].push(element("div", { class: "entry" }, element("p", null, colour ? dot(colour) : null, text),
    places.length ? element("div", { class: "places" }, ...places) : null));
}
report.findings.forEach((finding, i) => {
  const flaw = flaws.find(f => f.name === FLAW_OF_FINDING[finding.id]), MOST = 24;
  const places = finding.places.map(p => chip("point " + p.point, p.position));
  if (flaw) {
    places.push(...flaw.places.slice(0, MOST).map(p => chip(plural(p.count, "triangle"), place_of(...p.at))));
    if (flaw.places.length > MOST) places.push(soft("and " + plural(flaw.places.length - MOST, "more place")));
  }
  entry(finding.severity, flaw && flaw.colour, sentence(data.sentences[i]), places);
});
const MOST_DECISIONS = 100;
for (const d of report.loop_decisions.slice(0, MOST_DECISIONS))
  entry("doubt", null, "A loop of " + plural(d.points, "point") + ", " + number(d.width_spacings) + " spacings wide, " +
    (d.stays_open ? "stays open" : "was filled") + "; it is a boundary of the surface with a probability of " +
    Math.round(100 * d.probability) + " %" + (d.is_too_deep ? ", and too deep to be filled" : "") + ".",
    [chip("point " + d.at, data.places[d.at], d.width)]);
for (const d of report.facing_decisions.slice(0, MOST_DECISIONS))
  entry("doubt", null, "The front of a part of " + plural(d.triangles, "triangle") + " was chosen by the rule “" +
    d.rule + "”, with a certainty of " + Math.round(100 * d.certainty) + " %.", [chip("point " + d.at, data.places[d.at])]);
for (const [kind, all] of [["loop", report.loop_decisions], ["front of a part", report.facing_decisions]])
  if (all.length > MOST_DECISIONS)
    entry("doubt", null, "And " + plural(all.length - MOST_DECISIONS, "more decision") + " on a " + kind +
      ", surer than these; --report lists them.", []);
for (const warning of report.warnings)
  if (!data.sentences.includes(warning)) entry("note", null, sentence(warning), []);
const listed = (check.loops || []).filter(loop => data.places[loop.at]).slice(0, 20);
if (listed.length)
  entry("loop", null, plural(check.loops.length, "loop") +
    (listed.length < check.loops.length ? ", the longest " + listed.length + ":" : ":"),
    listed.map(loop => chip(plural(loop.points, "point"), data.places[loop.at], loop.width)));
for (const [title, entries] of Object.values(groups))
  if (entries.length) $("list").append(element("h3", null, title), ...entries);
if (!["flaw", "doubt", "note"].some(group => groups[group][1].length))
  $("list").prepend(element("p", null, "No flaws, no doubts."));

// Histograms and kinds of places.
function card(title, ...children) {
  $("below").append(element("div", { class: "card" }, element("h2", null, title), ...children));
}
function histogram(title, h, what) {
  if (!h) return;
  const W = 460, H = 150, n = h.counts.length, most = Math.max(...h.counts), x = i => 4 + i * (W - 8) / n;
  const to_scale = v => h.log ? Math.log(v) : v, from_scale = v => h.log ? Math.exp(v) : v;
  const low = to_scale(h.from), width = to_scale(h.to) - low, value = i => number(from_scale(low + i / n * width));
  const svg = element("svg", { viewBox: `0 0 ${W} ${H + 34}`, role: "img", "aria-label": title });
  h.counts.forEach((c, i) => svg.append(element("rect",
    { x: x(i), width: (W - 8) / n - 1, y: 14 + H - H * c / most, height: H * c / most, fill: "var(--bar)" },
    element("title", null, (i ? value(i) : "up") + " to " + (i < n - 1 ? value(i + 1) : "the largest") + ": " +
      plural(c, "point")))));
  svg.append(element("line", { x1: 4, x2: W - 4, y1: H + 14.5, y2: H + 14.5, stroke: "var(--soft)" }));
  const write = (x, y, anchor, text) =>
    svg.append(element("text", { x, y, fill: "var(--text)", "text-anchor": anchor }, text));
  for (let i = 0; i <= n; i += n / 4) write(x(i), H + 29, i ? i < n ? "middle" : "end" : "start", value(i));
  const m = x(width > 0 ? n * clamp((to_scale(h.median) - low) / width, 0, 1) : 0), is_right = m > W * 0.7;
  svg.append(element("line", { x1: m, x2: m, y1: 12, y2: H + 14, stroke: "var(--text)", "stroke-dasharray": "3 3" }));
  write(m + (is_right ? -4 : 4), 10, is_right ? "end" : "start", "median " + number(h.median));
  card(title, svg, element("p", { class: "soft" }, what + " Eight of ten points: " + number(h.quantile_10) + " to " +
    number(h.quantile_90) + ", all: " + number(h.least) + " to " + number(h.largest) + "."));
}
histogram("Spacing", data.histograms.spacing, "Mean distance of each point of the mesh to its six nearest, in units of " +
  "the cloud, on a logarithmic scale.");
histogram("Noise and bending", data.histograms.height, "How far each vertex is above or below the mean of its " +
  "neighbours, in spacings. " + (statistics.noise > 0 ? "The noise was measured: " + number(statistics.noise) +
  " spacings (median), 90 % below " + number(statistics.noise_quantile_90) + "." :
  report.viewpoint ? "Noise is not measured in a scan." : "No noise was found."));
const kinds = [["used", "in the mesh", statistics.used_points],
  ["scatter", "scatter: on no surface, such as leaves", statistics.scatter_points],
  ["outliers", "outliers: left out", statistics.outlier_points],
  ["unused", "unused: in no triangle", report.unused],
  ["stacked", "stacked: on other points", statistics.stacked_points],
  ["noisy", "noisy: connected by their projections", statistics.projected_points],
  ["remade", "remade: where several sheets are near", statistics.remade_points],
  ["repeated", "repeated: equal to others", statistics.duplicate_points],
  ["non_finite", "not finite", statistics.non_finite_points]];
card("Kinds of places", element("table", null, ...kinds.map(([name, label, n]) => element("tr", null,
  element("td", null, DOTS[name] ? dot(DOTS[name][0]) : null, label), element("td", { class: "number" }, count(n)),
  element("td", { class: "number soft" }, n ? number(100 * n / report.input.points) + " %" : "")))));
function table(title, object) {
  const text = v => Array.isArray(v) ? v.join(", ") : v && typeof v === "object" ? JSON.stringify(v) :
    typeof v === "string" || typeof v === "boolean" ? String(v) : number(v);
  $("more").append(element("details", { class: "card" }, element("summary", null, title), element("table", null,
    ...Object.entries(object).map(([key, value]) =>
      element("tr", null, element("td", null, key.replace(/_/g, " ")), element("td", null, text(value)))))));
}
table("Run", { program: report.tool + " " + report.version, input: report.input.file,
  output: report.output && report.output.file, method: report.topology + ": " + report.topology_reason,
  status: report.status, shift: report.shift, "memory, MB": Math.round(report.peak_memory_bytes / 1e6) });
table("All figures", statistics);
table("Seconds", report.seconds);
table("Options", report.options);

