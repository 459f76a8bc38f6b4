// Spheres and lines in WebGL2. A sphere is a square that faces the eye; each of its pixels asks where its line of sight
// meets the sphere, so it is round at any zoom and costs four corners.

const SPHERE_VERTEX = `#version 300 es
uniform mat4 view, projection; uniform float least;
in vec2 corner; in vec4 sphere; in vec3 color;
out vec3 center, at, tint; flat out float radius;
void main() {
  center = (view * vec4(sphere.xyz, 1.0)).xyz;
  // A grain far away stays a dot that can be seen.
  radius = max(sphere.w, -least * center.z); tint = color;
  // Seen from nearby a sphere sticks out of the square of its radius.
  float reach = radius * 1.5;
  at = center + vec3(corner * reach, 0.0);
  gl_Position = projection * vec4(at, 1.0);
}`;

const SPHERE_PIXEL = `#version 300 es
precision highp float;
uniform mat4 projection;
in vec3 center, at, tint; flat in float radius;
out vec4 shown;
void main() {
  vec3 sight = normalize(at);
  float along = dot(sight, center);
  float inside = radius * radius - dot(center, center) + along * along;
  if (inside < 0.0) discard;
  vec3 point = sight * (along - sqrt(inside));
  vec3 normal = (point - center) / radius;
  float key = max(dot(normal, normalize(vec3(-0.4, 0.7, 0.6))), 0.0);
  float fill = 0.5 + 0.5 * dot(normal, vec3(0.3, -0.4, 0.6));
  float rim = pow(1.0 - max(dot(normal, -sight), 0.0), 3.0);
  // A marked grain is white and has a black ring, which no map of colors has.
  float facing = dot(normal, -sight);
  bool marked = tint.r > 1.5;
  vec4 clip = projection * vec4(point, 1.0);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  if (marked) {
    shown = vec4(vec3(facing < 0.5 ? 0.0 : 1.0), 1.0);
    return;
  }
  shown = vec4(tint * (0.30 + 0.60 * key + 0.22 * fill) * (1.0 - 0.45 * rim), 1.0);
}`;

const LINE_VERTEX = `#version 300 es
uniform mat4 view, projection;
in vec3 end; in vec3 color;
out vec3 tint;
void main() { tint = color; gl_Position = projection * view * vec4(end, 1.0); }`;

const LINE_PIXEL = `#version 300 es
precision highp float;
in vec3 tint; out vec4 shown;
void main() { shown = vec4(tint, 1.0); }`;

const WALL_VERTEX = `#version 300 es
uniform mat4 view, projection;
in vec3 corner;
out vec3 at;
void main() { at = (view * vec4(corner, 1.0)).xyz; gl_Position = projection * vec4(at, 1.0); }`;

// A wall lets what is behind it through; the light is that of the spheres.
const WALL_PIXEL = `#version 300 es
precision highp float;
uniform vec3 tint;
in vec3 at; out vec4 shown;
void main() {
  vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
  float key = max(dot(normal, normalize(vec3(-0.4, 0.7, 0.6))), 0.0);
  shown = vec4(tint * (0.7 + 0.5 * key), 0.3);
}`;

class Scene {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL2");
    Object.assign(this, { canvas, gl });
    this.spheres = program(gl, SPHERE_VERTEX, SPHERE_PIXEL);
    this.lines = program(gl, LINE_VERTEX, LINE_PIXEL);
    this.walls = program(gl, WALL_VERTEX, WALL_PIXEL);
    this.buffers = Object.fromEntries(
      ["corner", "sphere", "color", "end", "lineColor", "wall", "edge", "edgeColor"].map((name) => [name, gl.createBuffer()]));
    fill(gl, this.buffers.corner, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    this.sphereCount = 0;
    this.lineEnds = 0;
    this.setWalls(new Walls(new Float32Array(0)), [0, 0, 0]);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  // Spheres [4 n]: center and radius, with colors [3 n].
  setSpheres(spheres, colors) {
    fill(this.gl, this.buffers.sphere, spheres);
    this.setColors(colors);
    this.sphereCount = spheres.length / 4;
  }

  setColors(colors) {
    fill(this.gl, this.buffers.color, colors);
  }

  // Lines by their ends [6 n] with a color for each end [6 n].
  setLines(ends, colors) {
    fill(this.gl, this.buffers.end, ends);
    fill(this.gl, this.buffers.lineColor, colors);
    this.lineEnds = ends.length / 3;
  }

  // Walls and their color.
  setWalls(walls, tint) {
    Object.assign(this, { shownWalls: walls, wallTint: tint });
    fill(this.gl, this.buffers.wall, walls.corners);
  }

  // Walls after all else, since it shows through them; those that turn their backs are not drawn, so one looks into a vessel.
  drawWalls(view, projection, eye) {
    const { gl, shownWalls, wallTint } = this;
    if (shownWalls.corners.length === 0) return;
    const edges = shownWalls.edges(eye);
    fill(gl, this.buffers.edge, edges);
    fill(gl, this.buffers.edgeColor, Float32Array.from(edges, (_, at) => 0.8 * wallTint[at % 3]));
    this.pass(this.lines, view, projection, [["end", 3, 0, "edge"], ["color", 3, 0, "edgeColor"]]);
    gl.drawArrays(gl.LINES, 0, edges.length / 3);
    gl.enable(gl.BLEND);
    gl.enable(gl.CULL_FACE);
    gl.depthMask(false);
    this.pass(this.walls, view, projection, [["corner", 3, 0, "wall"]]);
    gl.uniform3fv(gl.getUniformLocation(this.walls, "tint"), wallTint);
    gl.drawArrays(gl.TRIANGLES, 0, shownWalls.corners.length / 3);
    gl.depthMask(true);
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.BLEND);
  }

  // The radius of the smallest dot over its distance.
  least() {
    return (3 * Math.tan(Camera.FIELD / 2)) / Math.min(this.canvas.clientWidth, this.canvas.clientHeight);
  }

  draw(view, projection, background, eye) {
    const { gl, canvas } = this;
    const density = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth * density, canvas.clientHeight * density].map(Math.round);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.pass(this.spheres, view, projection, [["corner", 2, 0], ["sphere", 4, 1], ["color", 3, 1]]);
    if (this.sphereCount > 0) gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.sphereCount);
    this.pass(this.lines, view, projection, [["end", 3, 0], ["color", 3, 0, "lineColor"]]);
    if (this.lineEnds > 0) gl.drawArrays(gl.LINES, 0, this.lineEnds);
    this.drawWalls(view, projection, eye);
  }

  pass(program, view, projection, inputs) {
    const { gl } = this;
    gl.useProgram(program);
    gl.uniformMatrix4fv(gl.getUniformLocation(program, "view"), false, view);
    gl.uniformMatrix4fv(gl.getUniformLocation(program, "projection"), false, projection);
    gl.uniform1f(gl.getUniformLocation(program, "least"), this.least());
    for (const [name, size, divisor, buffer] of inputs) {
      const place = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[buffer ?? name]);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
      gl.vertexAttribDivisor(place, divisor);
    }
  }
}

function fill(gl, buffer, values) {
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
}

function program(gl, vertex, pixel) {
  const whole = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, pixel]]) {
    const part = gl.createShader(kind);
    gl.shaderSource(part, text);
    gl.compileShader(part);
    if (!gl.getShaderParameter(part, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(part));
    gl.attachShader(whole, part);
  }
  gl.linkProgram(whole);
  if (!gl.getProgramParameter(whole, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(whole));
  return whole;
}
