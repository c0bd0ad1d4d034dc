// SPDX-FileCopyrightText: 2026 The pcl_floater authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer.
function viewer() {
  const canvas = document.querySelector("canvas");
  const gl = mesh && canvas.getContext("webgl2", { preserveDrawingBuffer: true }); // kept for printing
  if (!gl) {
    document.body.className = "plain";
    canvas.replaceWith(element("p", { style: "padding:14px" }, mesh ?
      "This browser has no WebGL 2, which draws the mesh. Everything else is here." : "There is nothing to draw."));
    return;
  }
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, `#version 300 es
    layout(location = 0) in vec3 at; layout(location = 1) in vec3 normal;
    uniform mat4 view, projection; uniform float size, nearer; out vec3 eye, turned;
    void main() {
      vec4 e = view * vec4(at, 1.0);
      eye = e.xyz; turned = mat3(view) * normal;
      gl_Position = projection * e; gl_Position.z -= nearer * gl_Position.w; gl_PointSize = size;
    }`], [gl.FRAGMENT_SHADER, `#version 300 es
    precision highp float;
    in vec3 eye, turned; out vec4 colour; uniform vec3 front, back;
    uniform int kind; // 0: dot, 1: ring, 2: plain, 3: facets, 4: smooth
    void main() {
      float r = length(gl_PointCoord - 0.5) * 2.0;
      if (kind == 0) { if (r > 1.0) discard; colour = vec4(r > 0.72 ? front * 0.35 : front, 1.0); return; }
      if (kind == 1 && (r > 1.0 || r < 0.72)) discard;
      if (kind == 1) { colour = vec4(r > 0.93 || r < 0.79 ? vec3(1.0) : front, 1.0); return; }
      if (kind == 2) { colour = vec4(front, 1.0); return; }
      vec3 facet = normalize(cross(dFdx(eye), dFdy(eye))); // towards the eye
      vec3 n = kind == 4 && dot(turned, turned) > 0.0 ? normalize(turned) : facet;
      if (dot(n, facet) < 0.0) n = kind == 4 ? -n : n;
      float light = 0.30 + 0.55 * max(dot(n, normalize(vec3(-0.35, 0.55, 0.75))), 0.0) + 0.25 * abs(n.z);
      float shine = 0.18 * pow(max(reflect(normalize(vec3(0.35, -0.55, -0.75)), n).z, 0.0), 24.0);
      colour = vec4((gl_FrontFacing ? front : back) * light + shine, 1.0);
    }`]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  const u = {};
  for (const name of ["view", "projection", "size", "nearer", "front", "back", "kind"])
    u[name] = gl.getUniformLocation(program, name);
  const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);
  function buffer(values, target) {
    const made = gl.createBuffer();
    gl.bindBuffer(target || gl.ARRAY_BUFFER, made);
    gl.bufferData(target || gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    return { made, length: values.length };
  }
  const vertices = buffer(positions), vertex_normals = buffer(normals);
  const surface = buffer(Uint32Array.from(corners), gl.ELEMENT_ARRAY_BUFFER);
  for (const flaw of flaws) {
    const chosen = new Uint32Array(3 * flaw.numbers.length);
    flaw.numbers.forEach((t, i) => chosen.set(corners.subarray(3 * t, 3 * t + 3), 3 * i));
    flaw.surface = buffer(chosen, gl.ELEMENT_ARRAY_BUFFER);
    flaw.marks = buffer(Float32Array.from(flaw.places.flatMap(p => p.at)));
  }
  for (const kind of dots) kind.marks = buffer(kind.at);
  let edges = null; // made when they are needed
  function make_edges() {
    const lines = new Uint32Array(2 * corners.length);
    for (let i = 0; i < corners.length; ++i) {
      lines[2 * i] = corners[i];
      lines[2 * i + 1] = corners[i % 3 === 2 ? i - 2 : i + 1];
    }
    edges = buffer(lines, gl.ELEMENT_ARRAY_BUFFER);
  }

  // The camera looks at a target, from a direction given by two angles about an axis that is up.
  let up = [0, 0, 1], camera = null, home = null, flight = null, selected = null;
  let turns = false, facets = false, wants_edges = false;
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit_of = a => { const length = Math.hypot(...a) || 1; return a.map(x => x / length); };
  const sides = () => { const x = Math.abs(up[0]) > 0.5 ? [0, 1, 0] : [1, 0, 0]; return [x, cross(up, x)]; };
  function angles(direction) {
    const d = unit_of(direction), [x, y] = sides();
    return { yaw: Math.atan2(dot3(d, y), dot3(d, x)), pitch: clamp(Math.asin(clamp(dot3(d, up), -1, 1)), -1.5, 1.5) };
  }
  function axes(c) {
    const [x, y] = sides(), [cosine, sine] = [Math.cos(c.yaw), Math.sin(c.yaw)], flat = Math.cos(c.pitch);
    const back = XYZ.map(i => flat * (cosine * x[i] + sine * y[i]) + Math.sin(c.pitch) * up[i]);
    const right = unit_of(cross(up, back));
    return { right, above: cross(back, right), back };
  }
  const zoom_of = aspect => Math.min(1, aspect) / Math.tan(0.38);
  function go_home() { camera = { ...home, target: home.target.slice() }; selected = null; draw_soon(); }
  function set_up(axis, direction) { // all is just seen
    up = axis;
    home = { target: [0, 0, 0], ...angles(direction) };
    const { right, above, back } = axes(home), aspect = canvas.clientWidth / canvas.clientHeight;
    const all = positions.length ? positions : dots[0].at;
    home.distance = 0.1;
    for (let p = 0; p < all.length; p += 3) {
      const at = [all[p], all[p + 1], all[p + 2]];
      const reach = Math.max(Math.abs(dot3(right, at)) / aspect, Math.abs(dot3(above, at)));
      home.distance = Math.max(home.distance, dot3(back, at) + 1.06 * reach * zoom_of(aspect));
    }
    go_home();
  }
  function first_view() {
    const view = report.viewpoint, along = i => XYZ.map(j => i === j ? 1 : 0);
    const seen_from = view && (view.direction ? view.direction.map(x => -x) : drawn(view.place));
    if (view && (view.direction || Math.hypot(...seen_from) > 1)) // from where the sensor was, unless it was inside
      return set_up(Math.abs(unit_of(seen_from)[2]) > 0.8 && !view.direction ? [0, -1, 0] : [0, 0, 1], seen_from);
    // An open surface stands on its opening; whether it is a sheet tells the mean of its normals.
    const open = Math.hypot(...mean_normal), parts = mean_normal.map(Math.abs), axis = parts.indexOf(Math.max(...parts));
    const is_object = open > 0.02 && open < 0.4 && mean_normal[axis] > 0.8 * open;
    const chosen = is_object ? along(axis) : [0, 0, 1];
    const ground = XYZ.filter(i => !chosen[i]), wide = extent[ground[0]] >= extent[ground[1]] ? 1 : 0;
    const is_low = dot3(extent, chosen) < 0.35 * Math.max(...extent);
    const direction = chosen.map(x => (is_low ? 1.3 : 0.55) * x);
    direction[ground[wide]] = axis === 1 && is_object || wide === 0 ? 1 : -1; // across the longer side
    direction[ground[1 - wide]] += 0.45;
    set_up(chosen, direction);
  }
  function matrices() {
    const { right, above, back } = axes(camera), eye = camera.target.map((v, i) => v + camera.distance * back[i]);
    const view = XYZ.flatMap(i => [right[i], above[i], back[i], 0])
      .concat([-dot3(right, eye), -dot3(above, eye), -dot3(back, eye), 1]);
    const aspect = canvas.width / canvas.height, g = zoom_of(aspect);
    const near = camera.distance * (selected ? 0.4 : 0.08), far = camera.distance + 6, depth = near - far;
    return [view, [g / aspect, 0, 0, 0, 0, g, 0, 0, 0, 0, (far + near) / depth, -1, 0, 0, 2 * far * near / depth, 0]];
  }
  let is_waiting = false;
  function draw_soon() {
    if (!is_waiting) requestAnimationFrame(draw);
    is_waiting = true;
  }
  function bind(points, with_normals) {
    gl.bindBuffer(gl.ARRAY_BUFFER, points.made);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.disableVertexAttribArray(1);
    if (!with_normals) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, vertex_normals.made);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
  }
  function draw_elements(mode, indices, kind, front, back) {
    gl.uniform1i(u.kind, kind);
    gl.uniform3fv(u.front, front);
    gl.uniform3fv(u.back, back || front);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices.made);
    gl.drawElements(mode, indices.length, gl.UNSIGNED_INT, 0);
  }
  function draw_points(points, kind, colour, size, nearer) {
    bind(points);
    gl.uniform1i(u.kind, kind);
    gl.uniform3fv(u.front, colour);
    gl.uniform1f(u.size, size * (devicePixelRatio || 1));
    gl.uniform1f(u.nearer, nearer);
    gl.drawArrays(gl.POINTS, 0, points.length / 3);
  }
  function draw(now) {
    is_waiting = false;
    if (flight) fly(now);
    if (turns) { camera.yaw += 0.008; draw_soon(); }
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map(x => Math.round(x * (devicePixelRatio || 1)));
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    const [view, projection] = matrices();
    gl.uniformMatrix4fv(u.view, false, view);
    gl.uniformMatrix4fv(u.projection, false, projection);
    gl.uniform1f(u.nearer, 0);
    const is_close = camera.distance < 70 * spacing, shade = facets || is_close ? 3 : 4;
    bind(vertices, true);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    draw_elements(gl.TRIANGLES, surface, shade, rgb("#a8c0da"), rgb("#c9b79c"));
    gl.polygonOffset(0, 0);
    for (const flaw of flaws)
      if (flaw.on) draw_elements(gl.TRIANGLES, flaw.surface, shade, rgb(flaw.colour));
    if (wants_edges || is_close) {
      if (!edges) make_edges();
      gl.uniform1f(u.nearer, 0.00005);
      draw_elements(gl.LINES, edges, 2, rgb("#3d5068"));
    }
    if (is_close) { // flaws behind the surface shine through
      gl.disable(gl.DEPTH_TEST);
      gl.enable(gl.BLEND);
      gl.blendColor(0, 0, 0, 0.35);
      gl.blendFuncSeparate(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA, gl.ONE, gl.ONE_MINUS_CONSTANT_ALPHA);
      for (const flaw of flaws)
        if (flaw.on) draw_elements(gl.TRIANGLES, flaw.surface, shade, rgb(flaw.colour));
      gl.disable(gl.BLEND);
      gl.enable(gl.DEPTH_TEST);
    }
    for (const kind of dots)
      if (kind.on) draw_points(kind.marks, positions.length ? 0 : 2, rgb(kind.colour), positions.length ? 5 : 2, 0);
    for (const flaw of flaws)
      if (flaw.on && !is_close) draw_points(flaw.marks, 0, rgb(flaw.colour), 9, 0.002);
    if (selected) {
      gl.disable(gl.DEPTH_TEST);
      draw_points(selected, 1, rgb("#0b6cff"), 46, 0);
    }
  }
  // Flies to a place, in front of the surface there.
  function fly(now) {
    if (flight.begin == null) flight.begin = now;
    const t = Math.min(1, (now - flight.begin) / flight.time), s = t * t * (3 - 2 * t), { from, to } = flight;
    camera.target = from.target.map((v, i) => v + s * (to.target[i] - v));
    camera.distance = from.distance * (to.distance / from.distance) ** s;
    camera.yaw = from.yaw + s * (to.yaw - from.yaw);
    camera.pitch = from.pitch + s * (to.pitch - from.pitch);
    if (t === 1) flight = null; else draw_soon();
  }
  select = (at, width) => {
    let nearest = 0, least = Infinity;
    for (let p = 0; p < positions.length; p += 3) {
      const d = (positions[p] - at[0]) ** 2 + (positions[p + 1] - at[1]) ** 2 + (positions[p + 2] - at[2]) ** 2;
      if (d < least) [least, nearest] = [d, p];
    }
    const n = XYZ.map(i => normals[nearest + i] || 0), { back } = axes(camera);
    const seen = Math.hypot(...n) > 0 ? unit_of(n) : back; // with something of how it is seen now
    const to = { target: at, distance: Math.max(22 * spacing, 2.2 * width),
      ...angles(seen.map((v, i) => v + 0.5 * back[i])) };
    to.yaw = camera.yaw + Math.atan2(Math.sin(to.yaw - camera.yaw), Math.cos(to.yaw - camera.yaw));
    if (selected) gl.deleteBuffer(selected.made);
    selected = buffer(Float32Array.from(at));
    turns = false;
    const time = matchMedia("(prefers-reduced-motion: reduce)").matches ? 1 : 600; // milliseconds
    flight = { from: { ...camera }, to, begin: null, time };
    draw_soon();
  };

  const pointers = new Map();
  function move(dx, dy) {
    const { right, above } = axes(camera), step = camera.distance * 0.8 / canvas.clientHeight;
    camera.target = camera.target.map((v, i) => v + step * (dy * above[i] - dx * right[i]));
  }
  function zoom(factor) { camera.distance = clamp(camera.distance * factor, spacing / 2, 12); }
  function turn(dx, dy) {
    camera.yaw -= dx * 0.008;
    camera.pitch = clamp(camera.pitch + dy * 0.008, -1.55, 1.55);
  }
  canvas.addEventListener("pointerdown", e => {
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    canvas.setPointerCapture(e.pointerId);
    flight = null;
    turns = false;
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, e => pointers.delete(e.pointerId));
  canvas.addEventListener("pointermove", e => {
    const last = pointers.get(e.pointerId);
    if (!last) return;
    const [dx, dy] = [e.clientX - last[0], e.clientY - last[1]];
    const others = [...pointers].filter(([id]) => id !== e.pointerId);
    if (others.length) { // two fingers
      const distance = p => Math.hypot(p[0] - others[0][1][0], p[1] - others[0][1][1]);
      zoom(distance(last) / (distance([e.clientX, e.clientY]) || 1));
      move(dx / 2, dy / 2);
    } else if (e.buttons & 6 || e.shiftKey) move(dx, dy);
    else turn(dx, dy);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    draw_soon();
  });
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    flight = null;
    zoom(Math.exp((e.deltaMode ? 30 : 1) * e.deltaY * 0.0012));
    draw_soon();
  }, { passive: false });
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  canvas.addEventListener("dblclick", go_home);
  canvas.addEventListener("keydown", e => {
    const step = { ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12] }[e.key];
    if (step) turn(...step); else if (e.key === "+") zoom(0.85); else if (e.key === "-") zoom(1.18); else return;
    e.preventDefault();
    draw_soon();
  });
  addEventListener("resize", draw_soon);

  const switches = (is_on, change, ...label) => {
    const box = element("input", { type: "checkbox", onchange: () => { change(box.checked); draw_soon(); } });
    box.checked = is_on;
    return element("label", null, box, " ", ...label);
  };
  for (const kind of [...flaws, ...dots])
    $("legend").append(switches(true, on => kind.on = on, dot(kind.colour), kind.label + " (" +
      (kind.numbers ? plural(kind.count, "triangle") : count(kind.count)) +
      (kind.shown < kind.count ? ", " + count(kind.shown) + " shown" : "") + ")"));
  if (mesh.shown) $("legend").append(soft(dot("#a8c0da"), "front  ", dot("#c9b79c"), "back"));
  if (mesh.shown < mesh.triangles)
    $("legend").append(element("b", null, "Thinned: " + count(mesh.shown) + " of " + count(mesh.triangles) +
      " triangles are shown; " + (mesh.all_flaws ? "all of those with flaws." : "some of those with flaws are not.")));
  $("tools").append(element("button", { onclick: go_home }, "Whole mesh"),
    element("button", { onclick: () => { turns = !turns; draw_soon(); } }, "Turn"),
    switches(false, on => facets = on, "facets"), switches(false, on => wants_edges = on, "edges"),
    element("span", null, "up: ", ...XYZ.map(i => element("button", { onclick: () =>
      set_up(XYZ.map(j => i === j ? 1 : 0), XYZ.map(j => j === i ? 0.5 : j === (i + 1) % 3 ? 0.5 : 0.7)) }, "xyz"[i]))),
    element("span", null, "Drag to turn, right button to move, wheel to zoom, double click for all"));
  first_view();
}
viewer();
chips[(location.hash.match(/^#place=(\d+)$/) || [])[1] - 1]?.click();
if (!$("legend").children.length) $("legend").remove();
