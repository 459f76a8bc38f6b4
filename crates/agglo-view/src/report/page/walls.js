// Walls: triangles, seen from the side where grains are, and the edges that are drawn of them.

class Walls {
  // Corners of triangles [9 n], counted against the clock where they are seen from the side of the grains.
  constructor(corners) {
    this.corners = corners;
    this.sides = [];
    const known = new Map();
    for (let at = 0; at < corners.length; at += 9) {
      const triangle = [0, 3, 6].map((from) => [...corners.subarray(at + from, at + from + 3)]);
      const face = Walls.face(triangle);
      if (!face) continue;
      triangle.forEach((end, corner) => {
        const ends = [end, triangle[(corner + 1) % 3]];
        const name = ends.map((place) => place.join(" ")).sort().join(" ");
        const side = known.get(name) ?? { ends, faces: [] };
        if (side.faces.length === 0) {
          known.set(name, side);
          this.sides.push(side);
        }
        side.faces.push(face);
      });
    }
  }

  // The plane of a triangle: its normal and a point, or null of one without an area.
  static face([a, b, c]) {
    const [u, v] = [b, c].map((corner) => corner.map((part, k) => part - a[k]));
    const area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const size = Math.hypot(...area);
    return size > 0 ? { normal: area.map((part) => part / size), point: a } : null;
  }

  // Ends [6 n] of the edges that an eye sees: where a wall ends, where faces meet at an angle, and where a round one turns away.
  edges(eye) {
    const drawn = this.sides.filter(({ faces }) => {
      if (faces.length !== 2) return true;
      const [one, other] = faces.map(({ normal, point }) => dot(normal, eye) > dot(normal, point));
      return one !== other || dot(faces[0].normal, faces[1].normal) < Walls.SMOOTH;
    });
    return new Float32Array(drawn.flatMap(({ ends }) => ends.flat()));
  }

  // The ball about grains, made so large that it holds walls which are no farther away than grains are.
  within({ center, radius }) {
    let reach = radius;
    for (let at = 0; at < this.corners.length; at += 3) {
      const away = Math.hypot(...center.map((part, k) => this.corners[at + k] - part));
      if (away < 2 * radius) reach = Math.max(reach, away);
    }
    return { center, radius: reach };
  }
}
// Faces that meet at a smaller angle are parts of one that is round: its cosine.
Walls.SMOOTH = 0.8;
