// The replay: frames, the scene, and the controls around them.

// Brighter than any color: the scene draws it as a mark.
const CHOSEN = [2, 2, 2];

class Replay {
  constructor(root, plan, bytes) {
    Object.assign(this, { root, plan });
    this.frames = new Frames(plan, bytes);
    this.canvas = root.querySelector("canvas");
    this.scene = new Scene(this.canvas);
    this.camera = new Camera();
    this.part = (name) => root.querySelector(`[data-part=${name}]`);
    this.column = plan.columns.find((column) => column.name === plan.color_by) ?? plan.columns[0];
    this.chosen = null;
    this.playing = false;
    this.connect();
    this.show(plan.first);
  }

  // Brings a frame into the scene.
  show(frame) {
    this.frame = frame;
    this.grains = this.frames.grains(frame, Number(this.part("size").value));
    const { count, centers, radii } = this.grains;
    const spheres = new Float32Array(4 * count);
    for (let grain = 0; grain < count; grain += 1) {
      for (let k = 0; k < 3; k += 1) spheres[4 * grain + k] = centers[3 * grain + k];
      spheres[4 * grain + 3] = radii[grain];
    }
    this.showWalls();
    if (this.isOn("follow")) this.camera.fit(this.scene.shownWalls.within(ballOf(this.grains)));
    this.scene.setSpheres(spheres, this.sphereColors());
    this.showLines();
    this.part("scrub").value = frame;
    this.part("time").textContent = this.plan.times[frame];
    this.part("count").textContent = `${count} grains`;
    this.showChosen();
    this.draw();
  }

  sphereColors() {
    const { count, names } = this.grains;
    const values = this.frames.values(this.frame, this.column.name) ?? new Float32Array(count);
    const { colors: [low, high], map, name } = this.column;
    const nameColor = name === "cluster" ? clusterColor : named;
    const members = new Map();
    if (name === "cluster") values.forEach((cluster) => members.set(cluster, (members.get(cluster) ?? 0) + 1));
    const tints = new Float32Array(3 * count);
    for (let grain = 0; grain < count; grain += 1) {
      const value = values[grain];
      let color = map ? mapped(map, (value - low) / (high - low || 1)) : nameColor(value);
      if (members.get(value) === 1) color = ALONE;
      if (names[grain] === this.chosen) color = CHOSEN;
      for (let k = 0; k < 3; k += 1) tints[3 * grain + k] = color[k];
    }
    return tints;
  }

  showLines() {
    const none = new Float32Array(0);
    const bonds = this.isOn("bonds") ? this.frames.bonds(this.frame, this.grains.centers) : none;
    const rays = this.isOn("rays") ? this.frames.rays(this.frame, 0.02 * this.camera.size) : { ends: none, powers: none };
    const ends = new Float32Array(bonds.length + rays.ends.length);
    const colors = new Float32Array(ends.length);
    ends.set(bonds);
    colors.fill(0.55, 0, bonds.length);
    ends.set(rays.ends, bonds.length);
    const most = this.plan.ray_power || 1;
    // Neutral: the stage's opposite, and the nearer to the stage the weaker the ray.
    const stage = this.stageColor();
    const ink = stageInk(stage);
    const tone = (part) => stage.map((back, k) => back + part * (ink[k] - back));
    rays.powers.forEach((power, ray) => {
      const part = 0.35 + (0.65 * power) / most;
      colors.set([...tone(part), ...tone(0.4 * part)], bonds.length + 6 * ray);
    });
    this.scene.setLines(ends, colors);
  }

  showWalls() {
    const corners = this.isOn("walls") ? this.frames.walls(this.frame) : new Float32Array(0);
    this.scene.setWalls(new Walls(corners), wallColor(this.stageColor()));
  }

  isOn(name) {
    return this.part(name)?.checked ?? false;
  }

  stageColor() {
    return parseColor(getComputedStyle(this.root).getPropertyValue("--scene").trim().slice(1));
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
      this.scene.draw(this.camera.view(), this.camera.projection(aspect), this.stageColor(), this.camera.eye());
    });
  }

  play(on) {
    this.playing = on;
    const button = this.part("play");
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", on);
    if (!on) return;
    if (this.frame === this.frames.count - 1) this.show(0);
    this.shownAt = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }

  tick(now) {
    if (!this.playing) return;
    const due = 1000 / Number(this.part("rate").value);
    if (now - this.shownAt >= due) {
      this.shownAt = now;
      if (this.frame + 1 >= this.frames.count) return this.play(false);
      this.show(this.frame + 1);
    }
    requestAnimationFrame((next) => this.tick(next));
  }

  step(by) {
    this.play(false);
    this.show(Math.min(Math.max(this.frame + by, 0), this.frames.count - 1));
  }

  // The grain at a place of the window becomes the chosen one, or none.
  pick(event) {
    const box = this.canvas.getBoundingClientRect();
    const across = (2 * (event.clientX - box.left)) / box.width - 1;
    const upwards = 1 - (2 * (event.clientY - box.top)) / box.height;
    const sight = this.camera.sight(across, upwards, box.width / box.height);
    const grain = hit(sight, this.grains.centers, this.grains.radii, this.scene.least());
    this.choose(grain < 0 ? null : this.grains.names[grain]);
  }

  // Chooses a grain by its name, or none.
  choose(name) {
    this.chosen = name;
    this.part("name").value = name ?? "";
    this.repaint();
  }

  repaint() {
    this.scene.setColors(this.sphereColors());
    this.showChosen();
    this.draw();
  }

  showChosen() {
    const list = this.part("chosen");
    const grain = this.chosen === null ? -1 : this.grains.names.indexOf(this.chosen);
    list.hidden = this.chosen === null;
    if (this.chosen === null) return;
    const rows = [["grain", String(this.chosen)]];
    if (grain < 0) rows.push(["state", this.whyAbsent(this.chosen)]);
    for (const { name, label, unit } of grain < 0 ? [] : this.plan.columns) {
      const values = this.frames.values(this.frame, name);
      if (values && name !== "id") rows.push([label, `${quantity(values[grain])} ${unit}`.trim()]);
    }
    list.replaceChildren(...rows.flatMap(([what, how]) => [element("dt", what), element("dd", how)]));
  }

  // Why this frame does not have the grain of that name.
  whyAbsent(name) {
    const { share, can_vanish: canVanish } = this.plan;
    const having = this.frames.having(name);
    if (having.length === 0) {
      const thinned = share > 1 && name % share !== 0;
      return thinned ? `one of ${share} grains is shown; if there is a grain ${name}, it was left out` : `there is no grain ${name}`;
    }
    if (!canVanish) return "not in this frame";
    return having[0] > this.frame ? "not in this frame: it is made later" : "not in this frame: it merged or broke";
  }

  showLegend() {
    this.showColors();
    const stage = this.stageColor();
    const ink = css(stageInk(stage));
    if (this.isOn("rays")) this.addMark(`linear-gradient(to bottom, transparent 40%, ${ink} 40% 60%, transparent 60%)`, "rays");
    if (this.isOn("walls")) this.addMark(css(wallColor(stage)), "walls");
  }

  addMark(background, text) {
    const [entry, mark] = [element("s", ""), element("i", "")];
    mark.style.background = background;
    entry.append(mark, text);
    this.part("legend").append(entry);
  }

  showColors() {
    const { label, unit, colors: [low, high], map } = this.column;
    const legend = this.part("legend");
    legend.replaceChildren(element("span", unit ? `${label} [${unit}]` : label));
    if (!map) return this.showNames(legend);
    const bar = element("i", "");
    const stops = Array.from({ length: 11 }, (_, k) => css(mapped(map, k / 10)));
    bar.style.background = `linear-gradient(to right, ${stops.join(",")})`;
    legend.append(element("b", quantity(low)), bar, element("b", quantity(high)));
  }

  // The colors of the first names; there are more names than colors, and these come again.
  showNames(legend) {
    const isCluster = this.column.name === "cluster";
    const last = Math.min(this.column.high, isCluster ? 3 : NAMED.length - 1);
    const entries = Array.from({ length: last + 1 }, (_, number) => [named(number), isCluster ? "" : String(number)]);
    if (isCluster) {
      entries[0][1] = "heaviest";
      if (last > 0) entries[last][1] = "others";
      entries.push([ALONE, "single grains"]);
    }
    for (const [color, text] of entries) {
      const [entry, dot] = [element("s", ""), element("i", "")];
      dot.style.background = css(color);
      entry.append(dot, text);
      legend.append(entry);
    }
  }

  connect() {
    const scrub = this.part("scrub");
    scrub.max = this.frames.count - 1;
    scrub.addEventListener("input", () => { this.play(false); this.show(Number(scrub.value)); });
    this.part("play").addEventListener("click", () => this.play(!this.playing));
    this.part("back").addEventListener("click", () => this.step(-1));
    this.part("on").addEventListener("click", () => this.step(1));
    this.part("reset").addEventListener("click", () => this.reset());
    this.part("size").addEventListener("input", () => this.show(this.frame));
    this.part("follow").addEventListener("change", () => this.show(this.frame));
    this.part("name").addEventListener("change", ({ target }) => {
      this.choose(target.value === "" ? null : Number(target.value));
    });
    for (const name of ["bonds", "rays"]) {
      this.part(name)?.addEventListener("change", () => { this.showLines(); this.showLegend(); this.draw(); });
    }
    const choice = this.part("color");
    choice.replaceChildren(...this.plan.columns.map(({ name, label }) => new Option(label, name)));
    choice.value = this.column.name;
    choice.addEventListener("change", () => {
      this.column = this.plan.columns.find((column) => column.name === choice.value);
      this.showLegend();
      this.repaint();
    });
    this.part("walls")?.addEventListener("change", () => { this.show(this.frame); this.showLegend(); });
    this.showLegend();
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.showLines();
      this.showWalls();
      this.showLegend();
      this.draw();
    });
    followPointers(this.canvas, this.camera, (moved) => this.moved(moved), (event) => this.pick(event));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  // Who zooms or moves by hand does not want to be carried along any more; who turns does.
  moved(byHand) {
    if (byHand) this.part("follow").checked = false;
    this.draw();
  }

  reset() {
    Object.assign(this.camera, new Camera());
    this.part("follow").checked = true;
    this.show(this.frame);
  }

  key(event) {
    const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
    const acts = {
      " ": () => this.play(!this.playing),
      "+": () => { this.camera.zoom(0.9); this.moved(true); },
      "-": () => { this.camera.zoom(1 / 0.9); this.moved(true); },
      ",": () => this.step(-1),
      ".": () => this.step(1),
      Home: () => this.reset(),
      Escape: () => this.choose(null),
    };
    const act = turns[event.key] ? () => this.camera.turn(...turns[event.key]) : acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
    this.draw();
  }
}

function element(kind, text) {
  const made = document.createElement(kind);
  made.textContent = text;
  return made;
}
