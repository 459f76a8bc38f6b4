// The frames of the replay: unpacked when they are shown, since all of them at once may not fit into memory.

// What a block of the page holds: base64 of deflated bytes.
async function unpack(id) {
  const text = document.getElementById(id).textContent.trim();
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Response(stream).arrayBuffer();
}

// Frames of grains, bonds, rays and walls. `plan` says where each array lies in `bytes`.
class Frames {
  constructor(plan, bytes) {
    this.plan = plan;
    this.bytes = bytes;
  }

  get count() {
    return this.plan.frames.length;
  }

  time(frame) {
    return this.plan.frames[frame].time;
  }

  // One array of a frame as numbers in its own units, or null if the frame has none of that name.
  values(frame, name) {
    const entry = this.plan.frames[frame].arrays[name];
    if (!entry) return null;
    const { offset, count, kind, low, high } = entry;
    if (kind === "u32") return new Uint32Array(this.bytes, offset, count);
    const raw = new Uint16Array(this.bytes, offset, count);
    const step = (high - low) / 65535;
    const values = new Float32Array(count);
    for (let at = 0; at < count; at += 1) values[at] = low + step * raw[at];
    return values;
  }

  // The frames that have a grain of that name.
  having(name) {
    const all = Array.from({ length: this.count }, (_, frame) => frame);
    return all.filter((frame) => this.values(frame, "id").includes(name));
  }

  // Centers [3 n], radii [n] (times `part`, to be drawn smaller) and names [n] of the grains.
  grains(frame, part) {
    const names = this.values(frame, "id");
    return {
      count: names.length,
      names,
      centers: interleave(["x", "y", "z"].map((axis) => this.values(frame, axis))),
      radii: this.values(frame, "size").map((radius) => part * radius),
    };
  }

  // Ends of the lines between bonded grains [6 n].
  bonds(frame, centers) {
    const pairs = this.values(frame, "bonds");
    if (!pairs) return new Float32Array(0);
    const ends = new Float32Array(3 * pairs.length);
    pairs.forEach((grain, at) => ends.set(centers.subarray(3 * grain, 3 * grain + 3), 3 * at));
    return ends;
  }

  // Rays as short lines back along their way [6 n] and their powers [n].
  rays(frame, length) {
    const axes = ["ray_x", "ray_y", "ray_z"].map((name) => this.values(frame, name));
    if (!axes[0]) return { ends: new Float32Array(0), powers: new Float32Array(0) };
    const way = ["ray_u", "ray_v", "ray_w"].map((name) => this.values(frame, name));
    const ends = new Float32Array(6 * axes[0].length);
    for (let ray = 0; ray < axes[0].length; ray += 1) {
      for (let k = 0; k < 3; k += 1) {
        ends[6 * ray + k] = axes[k][ray];
        ends[6 * ray + 3 + k] = axes[k][ray] - length * way[k][ray];
      }
    }
    return { ends, powers: this.values(frame, "ray_power") };
  }

  // Corners of the triangles of walls [9 n].
  walls(frame) {
    const axes = ["wall_x", "wall_y", "wall_z"].map((name) => this.values(frame, name));
    return axes[0] ? interleave(axes) : new Float32Array(0);
  }
}

function interleave(axes) {
  const count = axes[0].length;
  const all = new Float32Array(axes.length * count);
  axes.forEach((axis, k) => {
    for (let at = 0; at < count; at += 1) all[axes.length * at + k] = axis[at];
  });
  return all;
}
