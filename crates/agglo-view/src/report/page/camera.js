// An eye that goes round a point. It fits what it is given into the window; z is up.

class Camera {
  constructor() {
    Object.assign(this, { azimuth: 0.6, height: 0.35, target: [0, 0, 0], size: 1, distance: 1 });
  }

  // Looks at a ball of this center and radius from as far as shows all of it.
  fit({ center, radius }) {
    this.target = [...center];
    this.size = 2 * radius || 1;
    this.distance = (1.08 * radius || 1) / Math.sin(Camera.FIELD / 2);
  }

  // Unit vectors to the right, upwards, and from the point to the eye.
  axes() {
    const [ca, sa, ch, sh] = [this.azimuth, this.height].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
    return { right: [ca, sa, 0], up: [-sa * sh, ca * sh, ch], back: [sa * ch, -ca * ch, sh] };
  }

  eye() {
    const { back } = this.axes();
    return this.target.map((center, k) => center + this.distance * back[k]);
  }

  view() {
    const { right, up, back } = this.axes();
    const eye = this.eye();
    const shift = [right, up, back].map((axis) => -dot(axis, eye));
    return new Float32Array([0, 1, 2].flatMap((k) => [right[k], up[k], back[k], 0]).concat(shift, 1));
  }

  projection(aspect) {
    const [near, far] = [this.distance * 0.02, this.distance + 20 * this.size];
    const scale = 1 / Math.tan(Camera.FIELD / 2);
    // In a narrow window the width, not the height, must hold the scene.
    const [wide, tall] = aspect > 1 ? [scale / aspect, scale] : [scale, scale * aspect];
    return new Float32Array([wide, 0, 0, 0, 0, tall, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0,
      (-2 * far * near) / (far - near), 0]);
  }

  // The line of sight through a place of the window, both from -1 to 1.
  sight(across, upwards, aspect) {
    const { right, up, back } = this.axes();
    const slope = Math.tan(Camera.FIELD / 2);
    const [wide, tall] = aspect > 1 ? [slope * aspect, slope] : [slope, slope / aspect];
    const way = back.map((b, k) => across * wide * right[k] + upwards * tall * up[k] - b);
    const length = Math.hypot(...way);
    return { from: this.eye(), way: way.map((part) => part / length) };
  }

  turn(across, upwards) {
    this.azimuth -= across;
    this.height = Math.min(Math.max(this.height + upwards, -1.55), 1.55);
  }

  move(across, upwards) {
    const { right, up } = this.axes();
    this.target = this.target.map((center, k) => center - this.distance * (across * right[k] + upwards * up[k]));
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 0.02 * this.size), 40 * this.size);
  }
}
Camera.FIELD = 0.7;

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The ball that holds nearly all grains: a few that fly far off do not make the others small.
function ballOf({ count, centers, radii }) {
  // Some thousands tell where nearly all are.
  const stride = Math.ceil(count / 4000);
  const samples = Math.ceil(count / stride);
  const places = new Float32Array(samples);
  const sorted = (value) => {
    for (let at = 0; at < samples; at += 1) places[at] = value(stride * at);
    return places.sort();
  };
  const [low, high] = [Math.floor(0.03 * (samples - 1)), Math.ceil(0.97 * (samples - 1))];
  const center = [0, 1, 2].map((k) => {
    const line = sorted((grain) => centers[3 * grain + k]);
    return (line[low] + line[high]) / 2;
  });
  const reach = (grain) => radii[grain] + Math.hypot(
    centers[3 * grain] - center[0], centers[3 * grain + 1] - center[1], centers[3 * grain + 2] - center[2]);
  const most = sorted(reach)[high];
  let all = 0;
  for (let grain = 0; grain < count; grain += 1) all = Math.max(all, reach(grain));
  // All of them where that costs little.
  return { center, radius: (all < 1.5 * most ? all : most) || 1 };
}

// The first sphere on a line of sight, or -1. Spheres are at least `least` times their distance large.
function hit({ from, way }, centers, radii, least) {
  let [first, nearest] = [-1, Infinity];
  for (let grain = 0; grain < radii.length; grain += 1) {
    const off = [centers[3 * grain] - from[0], centers[3 * grain + 1] - from[1], centers[3 * grain + 2] - from[2]];
    const along = dot(off, way);
    const radius = Math.max(radii[grain], least * along);
    const inside = radius ** 2 - dot(off, off) + along * along;
    if (inside < 0) continue;
    const distance = along - Math.sqrt(inside);
    if (distance > 0 && distance < nearest) [first, nearest] = [grain, distance];
  }
  return first;
}
